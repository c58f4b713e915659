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

/// The chunks of an MCAP file, or of a bag, without compression; those used last are kept. Not thread-safe.
class McapChunkCache {
 public:
  explicit McapChunkCache(const std::vector<McapChunk>& chunks) : chunks_(chunks), states_(chunks.size()) {}

  /// Returns the records of a chunk, valid until the next call; no data if it is damaged. A checksum is compared once.
  ByteView records(std::size_t chunk);
  /// Returns how often a chunk was decompressed.
  std::uint64_t inflated() const { return inflated_; }
  /// Returns what is wrong with chunks that were asked for.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  enum class State : std::uint8_t { Unknown, Good, Damaged };
  struct Kept {
    std::size_t chunk;
    Inflated inflated;
  };

  ByteView inflateChunk(std::size_t chunk);
  /// Forgets chunks that end before a time, ns: messages in order of receipt do not return to them, and the next one is
  /// written to memory that is still in the processor's cache.
  void dropEarlier(std::uint64_t start);
  void makeRoom();

  const std::vector<McapChunk>& chunks_;
  std::vector<State> states_;
  std::list<Kept> kept_;  // the one used last first
  std::size_t kept_bytes_ = 0;
  std::uint64_t inflated_ = 0;
  std::vector<std::string> warnings_;
};

}  // namespace urban_nav_input
