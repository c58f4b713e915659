// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/mcap_chunk_cache.hpp"

#include <algorithm>
#include <iterator>

#include "recording/storage/crc32.hpp"

namespace urban_nav_input {

namespace {

constexpr std::size_t kMostKept = 64U << 20U;  // bytes, beyond the chunk in use
constexpr std::size_t kMostChunks = 16;

}  // namespace

ByteView McapChunkCache::records(std::size_t chunk) {
  if (states_[chunk] == State::Damaged) return {};
  const mcap::Chunk& packed = chunks_[chunk].chunk;
  const bool is_cut = packed.packed.size != packed.packed_size;
  const ByteView bytes = packed.compression.empty() ? packed.packed : inflateChunk(chunk);
  if (states_[chunk] == State::Good) return bytes;
  const char* fault = nullptr;
  if (bytes.data == nullptr) fault = "cannot be decompressed";
  else if (!is_cut && packed.crc != 0 && crc32(bytes) != packed.crc) fault = "has a wrong checksum";
  states_[chunk] = fault != nullptr ? State::Damaged : State::Good;
  if (fault == nullptr) return bytes;
  warnings_.push_back("chunk at byte " + std::to_string(chunks_[chunk].begin) + " " + fault +
                      ": its messages are left out");
  return {};
}

ByteView McapChunkCache::inflateChunk(std::size_t chunk) {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.chunk == chunk; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return found->inflated.bytes();
  }
  const mcap::Chunk& packed = chunks_[chunk].chunk;
  dropEarlier(packed.start);
  ++inflated_;
  Inflated inflated = inflate(packed.compression, packed.packed, static_cast<std::size_t>(packed.size));
  if (!inflated.is_whole && packed.packed.size == packed.packed_size) return {};
  kept_bytes_ += inflated.size;
  kept_.push_front({chunk, std::move(inflated)});
  makeRoom();
  return kept_.front().inflated.bytes();
}

void McapChunkCache::dropEarlier(std::uint64_t start) {
  for (auto kept = kept_.begin(); kept != kept_.end();) {
    const bool is_over = chunks_[kept->chunk].chunk.end < start;
    if (is_over) kept_bytes_ -= kept->inflated.size;
    kept = is_over ? kept_.erase(kept) : std::next(kept);
  }
}

void McapChunkCache::makeRoom() {
  while (kept_.size() > 1 && (kept_.size() > kMostChunks || kept_bytes_ - kept_.front().inflated.size > kMostKept)) {
    kept_bytes_ -= kept_.back().inflated.size;
    kept_.pop_back();
  }
}

}  // namespace urban_nav_input
