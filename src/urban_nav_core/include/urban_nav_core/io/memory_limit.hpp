// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace urban_nav_core {

/// Returns the memory that the process is meant to use, in bytes: 4000 MB unless setMemoryLimit() was called. A global
/// setting of the process, like its limit of open files, because decompression takes place in many modules and each
/// must bound its memory against malicious files. Thread-safe.
std::size_t memoryLimit();
/// Sets the limit (parameter `memory_mb` of the command). Thread-safe.
void setMemoryLimit(std::size_t bytes);

/// Returns an eighth of memoryLimit(): the limit of one decompressed unit (chunk, message, file), which leaves room for
/// copies in other representations.
std::size_t largestPiece();
/// Returns the limit of one decoded image, bytes: half of largestPiece(), because several are held at once.
std::size_t largestImage();

}  // namespace urban_nav_core
