// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "recording/storage/mcap_records.hpp"
#include "urban_nav_input/recording/connection.hpp"
#include "urban_nav_input/recording/message_entry.hpp"

namespace urban_nav_input {

/// Chunk of an MCAP file.
struct McapChunk {
  std::uint64_t begin = 0;  ///< position of its record in the file
  mcap::Chunk chunk;
  std::map<std::uint16_t, std::uint64_t> indexes;  ///< positions of the MessageIndex records by channel
};

/// Contents of an MCAP file by its index or by all its records.
struct McapContents {
  std::map<std::uint16_t, mcap::Schema> schemas;
  std::map<std::uint16_t, mcap::Channel> channels;
  std::vector<McapChunk> chunks;  ///< in the order of the file
  bool is_indexed = false;        ///< entries come from McapChunk::indexes
  /// Messages by channel, if the file is not indexed; MessageEntry::place by makePlace().
  std::map<std::uint16_t, std::vector<MessageEntry>> entries;
  std::vector<std::string> warnings;
};

/// Returns the place of a message record: its offset in the decompressed chunk, or in the file for messages outside of
/// chunks (chunk = kNoChunk).
constexpr std::uint64_t kNoChunk = 0xffffff;
constexpr std::uint64_t makePlace(std::uint64_t chunk, std::uint64_t offset) { return chunk << 40U | offset; }
constexpr std::uint64_t placedChunk(std::uint64_t place) { return place >> 40U; }
constexpr std::uint64_t placedOffset(std::uint64_t place) { return place & 0xffffffffffU; }

/// Reads the summary of an MCAP file if it is complete, has an index of all messages and a correct checksum; otherwise
/// all complete records, which decompresses all chunks. Throws UserError naming `path` for an unsupported compression.
McapContents readMcapContents(const std::string& path, ByteView file);

}  // namespace urban_nav_input
