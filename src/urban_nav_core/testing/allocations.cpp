// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/allocations.hpp"

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)
#define URBAN_NAV_COUNTS_ALLOCATIONS 0
#else
#define URBAN_NAV_COUNTS_ALLOCATIONS 1
#endif

#if URBAN_NAV_COUNTS_ALLOCATIONS

// glibc's own entry points, under which malloc can be replaced by a program without touching dlsym: operator new and
// Eigen's aligned buffers both end here.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* old, std::size_t size);               // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
}

namespace {
thread_local std::int64_t count = 0;
}

extern "C" {
void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  ++count;
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
  ++count;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++count;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++count;
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? 12 : 0;  // ENOMEM
}
}

namespace urban_nav_core::testing {
std::int64_t allocations() { return count; }
bool countsAllocations() { return true; }
}  // namespace urban_nav_core::testing

#else

namespace urban_nav_core::testing {
std::int64_t allocations() { return 0; }
bool countsAllocations() { return false; }
}  // namespace urban_nav_core::testing

#endif
