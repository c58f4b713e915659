// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Decompressed bytes.
struct Inflated {
  std::unique_ptr<std::uint8_t[]> memory;
  std::size_t size = 0;
  bool is_whole = false;  ///< all expected bytes, without damage

  ByteView bytes() const { return {memory.get(), size}; }
};

/// Returns whether a name is that of a compression of MCAP ("zstd", "lz4"); "" is no compression.
bool isKnownCompression(const std::string& compression);

/// Decompresses frames of zstd or lz4, or a stream of bz2, to `size` bytes. Truncated or damaged data are decompressed
/// up to the last complete block; not at all if `size` exceeds urban_nav_core::largestPiece(). Requires "zstd", "lz4"
/// or "bz2".
Inflated inflate(const std::string& compression, ByteView packed, std::size_t size);

}  // namespace urban_nav_input
