// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Bytes without compression.
struct Inflated {
  std::unique_ptr<std::uint8_t[]> memory;
  std::size_t size = 0;
  bool is_whole = false;  ///< all bytes that were expected, and nothing was damaged

  ByteView bytes() const { return {memory.get(), size}; }
};

/// Returns whether "zstd", "lz4" or whatever a file names is a compression of MCAP; "" is no compression.
bool isKnownCompression(const std::string& compression);

/// Decompresses frames of zstd or lz4, or a stream of bz2, to `size` bytes. What is cut off or damaged is inflated as
/// far as it goes, to whole blocks; nothing is, if `size` exceeds urban_nav_core::largestPiece(). Requires "zstd",
/// "lz4" or "bz2".
Inflated inflate(const std::string& compression, ByteView packed, std::size_t size);

}  // namespace urban_nav_input
