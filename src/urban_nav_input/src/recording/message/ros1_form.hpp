// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "recording/message/transcoder.hpp"
#include "urban_nav_input/recording/connection.hpp"

namespace urban_nav_input {

/// Converts messages of a connection to ROS 1: to the type of the suite with this name, or to the type defined in the
/// recording. Not thread-safe.
class Ros1Form {
 public:
  /// Throws std::invalid_argument with the reason if the messages cannot be decoded.
  explicit Ros1Form(const Connection& connection);

  /// Returns the connection with the type, the definition and the MD5 sum of ROS 1.
  const Connection& connection() const { return connection_; }
  /// Returns a message in the serialization of ROS 1, valid until the next call. Throws std::runtime_error if its
  /// encoding is not that of the connection, or it ends too early.
  ByteView convert(ByteView message);

 private:
  void transcode(const Connection& connection);

  Connection connection_;
  std::optional<Transcoder> transcoder_;
};

}  // namespace urban_nav_input
