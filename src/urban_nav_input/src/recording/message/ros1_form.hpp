// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "recording/message/transcoder.hpp"
#include "urban_nav_input/recording/connection.hpp"

namespace urban_nav_input {

/// Messages of a connection as those of ROS 1: of the type that the suite knows by this name, or of that which the
/// definition in the recording describes. Not thread-safe.
class Ros1Form {
 public:
  /// Throws std::invalid_argument with the reason if the messages cannot be decoded.
  explicit Ros1Form(const Connection& connection);

  /// Returns the connection with the type, the definition and the MD5 sum of ROS 1.
  const Connection& connection() const { return connection_; }
  /// Returns a message in the serialization of ROS 1, valid until the next call. Throws std::runtime_error if it is in
  /// another encoding than its connection states, or ends too early.
  ByteView convert(ByteView message);

 private:
  void transcode(const Connection& connection);

  Connection connection_;
  std::optional<Transcoder> transcoder_;
};

}  // namespace urban_nav_input
