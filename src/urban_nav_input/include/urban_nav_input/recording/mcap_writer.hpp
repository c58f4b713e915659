// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Topic of an MCAP file to write.
struct McapChannel {
  std::string topic;
  std::string type;             ///< "sensor_msgs/msg/Image"
  std::string schema_encoding;  ///< "ros2msg", or "" if there is no definition
  std::string definition;
  std::string encoding;                         ///< messages: "cdr"
  std::map<std::string, std::string> metadata;  ///< more about the topic
};

/// Writes an MCAP file of profile ros2: chunks compressed by zstd, with index, statistics and all checksums. The file
/// appears when it is complete. The same messages give the same bytes. Throws UserError naming the file if it cannot
/// be written. Not thread-safe.
class McapWriter {
 public:
  explicit McapWriter(const std::string& path);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Returns the number of a new channel. Throws UserError beyond 65 535 of them.
  std::uint16_t addChannel(const McapChannel& channel);
  /// Appends a message. `receipt`: ns.
  void write(std::uint16_t channel, urban_nav_core::StampNs receipt, ByteView message);
  /// Returns the size of the file so far, bytes, with the current chunk uncompressed.
  std::uint64_t size() const;
  /// Completes the file and renames it to its final name.
  void commit();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace urban_nav_input
