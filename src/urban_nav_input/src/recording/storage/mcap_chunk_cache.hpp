// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <string>
#include <vector>

#include "recording/storage/inflate.hpp"
#include "recording/storage/mcap_contents.hpp"

namespace urban_nav_input {

/// LRU cache of the decompressed chunks of an MCAP file or a bag. Not thread-safe.
class McapChunkCache {
 public:
  explicit McapChunkCache(const std::vector<McapChunk>& chunks) : chunks_(chunks), states_(chunks.size()) {}

  /// Returns the records of a chunk, valid until the next call; no data if it is damaged. Checks each checksum once.
  ByteView records(std::size_t chunk);
  /// Returns the number of decompressions.
  std::uint64_t inflated() const { return inflated_; }
  /// Returns the defects of requested chunks.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  enum class State : std::uint8_t { Unknown, Good, Damaged };
  struct Kept {
    std::size_t chunk;
    Inflated inflated;
  };

  ByteView inflateChunk(std::size_t chunk);
  /// Drops chunks that end before a time, ns, which are not needed again when reading in order of receipt; the next one
  /// reuses their memory, which is still in the processor cache.
  void dropEarlier(std::uint64_t start);
  void makeRoom();

  const std::vector<McapChunk>& chunks_;
  std::vector<State> states_;
  std::list<Kept> kept_;  // most recently used first
  std::size_t kept_bytes_ = 0;
  std::uint64_t inflated_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace urban_nav_input
