// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/io/memory_limit.hpp"

namespace urban_nav_core::testing {

/// Sets another memory limit for a test; the destructor restores the previous one.
class LimitedMemory {
 public:
  explicit LimitedMemory(std::size_t bytes) : before_(memoryLimit()) { setMemoryLimit(bytes); }
  ~LimitedMemory() { setMemoryLimit(before_); }
  LimitedMemory(const LimitedMemory&) = delete;
  LimitedMemory& operator=(const LimitedMemory&) = delete;

 private:
  std::size_t before_;
};

}  // namespace urban_nav_core::testing
