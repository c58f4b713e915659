// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "recording/storage/bag_records.hpp"
#include "recording/storage/mcap_contents.hpp"
#include "urban_nav_input/recording/connection.hpp"
#include "urban_nav_input/recording/message_entry.hpp"

namespace urban_nav_input {

/// Contents of a ROS 1 bag from its records, without the index.
struct BagScan {
  std::vector<Connection> connections;             ///< in the order of the file
  std::vector<std::uint32_t> ids;                  ///< ids of the connections in the bag
  std::vector<std::vector<MessageEntry>> entries;  ///< index: connection; MessageEntry::place by makePlace()
  std::vector<McapChunk> chunks;                   ///< in the form of MCAP chunks
  std::vector<std::string> warnings;               ///< damage with its place
  std::uint64_t messages = 0;
};

/// Return the content of a record of a bag: of a Connection; of a Chunk, nullopt for an unsupported compression; and a
/// time, whose seconds are its lower half.
Connection readConnection(const rosbag1::Record& record);
std::optional<McapChunk> readChunk(const rosbag1::Record& record);
urban_nav_core::StampNs readBagTime(std::uint64_t time);

/// Reads all records of a bag without its index, up to truncation or damage, which decompresses all chunks. Throws
/// UserError naming `path` for encryption or an unsupported compression. Requires that the file begins with
/// rosbag1::kMagic.
BagScan scanBag(const std::string& path, ByteView file);

}  // namespace urban_nav_input
