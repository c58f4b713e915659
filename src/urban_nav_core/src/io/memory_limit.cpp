// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/memory_limit.hpp"

#include <atomic>

namespace urban_nav_core {

namespace {

std::atomic<std::size_t>& limit() {
  static std::atomic<std::size_t> bytes{std::size_t{4000} << 20U};
  return bytes;
}

}  // namespace

std::size_t memoryLimit() { return limit().load(); }
void setMemoryLimit(std::size_t bytes) { limit().store(bytes); }
std::size_t largestPiece() { return memoryLimit() / 8; }
std::size_t largestImage() { return largestPiece() / 2; }

}  // namespace urban_nav_core
