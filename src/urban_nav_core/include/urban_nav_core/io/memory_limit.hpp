// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace urban_nav_core {

/// Memory that the process is meant to use, in bytes: 4000 MB unless setMemoryLimit() was called. A property of the
/// process, like its limit of open files, because what is compressed is decompressed in many places, none of which may
/// take all memory for a file that was made to do so. Thread-safe.
std::size_t memoryLimit();
/// Sets the limit; the command does so with its parameter `memory_mb`. Thread-safe.
void setMemoryLimit(std::size_t bytes);

/// Returns an eighth of memoryLimit(): the most bytes that one compressed piece (chunk, message, file) may have once it
/// is decompressed, with room left for copies in other representations.
std::size_t largestPiece();
/// Returns the most bytes that one decoded image may have: half of largestPiece(), because several are held at once.
std::size_t largestImage();

}  // namespace urban_nav_core
