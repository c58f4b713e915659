// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>

/// Vectors of the compiler's own, for the kernels of this folder that are compiled once for every width and chosen at
/// run time. All is inlined into functions that name their processor: nothing of this may be called from elsewhere.

#if defined(__x86_64__)
#define URBAN_NAV_X86 1
#endif

#define URBAN_NAV_INLINE __attribute__((always_inline)) inline

// Vectors wider than the baseline's are handed between functions that are all inlined: there is no call whose ABI
// could change.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace urban_nav_core::vectors {

template <typename V, typename T>
URBAN_NAV_INLINE V load(const T* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

template <typename V, typename T>
URBAN_NAV_INLINE void store(T* p, const V& v) {
  std::memcpy(p, &v, sizeof v);
}

}  // namespace urban_nav_core::vectors
