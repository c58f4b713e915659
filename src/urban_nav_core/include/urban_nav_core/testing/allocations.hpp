// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace urban_nav_core::testing {

/// Returns the number of calls of operator new, malloc and aligned_alloc by this thread. Counted in programs that link
/// the testing library and use this function; with a sanitizer, whose allocator cannot be replaced, it is always zero
/// and countsAllocations() returns false.
std::int64_t allocations();
bool countsAllocations();

/// Usage: `const AllocationCount count; work(); EXPECT_EQ(count.sofar(), 0);`
class AllocationCount {
 public:
  AllocationCount() : before_(allocations()) {}
  std::int64_t sofar() const { return allocations() - before_; }

 private:
  std::int64_t before_;
};

}  // namespace urban_nav_core::testing
