// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/connection.hpp"

namespace urban_nav_input {

/// Writes a recording, which appears when it is complete. The same messages give the same bytes. Throws UserError
/// naming the file if it cannot be written. Not thread-safe.
class RecordingWriter {
 public:
  RecordingWriter() = default;
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  virtual ~RecordingWriter() = default;

  /// Returns the reason why messages of a connection cannot be written; nullopt if they can.
  virtual std::optional<std::string> refusal(const Connection& connection) = 0;
  /// Appends a message in the encoding of its connection. The connection is identified by its address, which must stay
  /// valid. Requires that refusal() is empty. Throws std::runtime_error if the bytes end before the message.
  virtual void write(const Connection& connection, urban_nav_core::StampNs receipt, ByteView message) = 0;
  /// Returns the size of the file so far, bytes.
  virtual std::uint64_t size() const = 0;
  /// Completes the file and renames it to its final name.
  virtual void commit() = 0;
};

/// Returns a writer of a ROS 1 bag for a path that ends in ".bag", or of MCAP for ".mcap". Converts
/// messages if the encodings differ: to ROS 1 for a bag, to CDR for MCAP, which copies undecodable messages unchanged.
/// Throws UserError for another extension.
std::unique_ptr<RecordingWriter> createRecording(const std::string& path);
/// Returns a writer of a ROS 1 bag for any extension.
std::unique_ptr<RecordingWriter> createBag(const std::string& path);

}  // namespace urban_nav_input
