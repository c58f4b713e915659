// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>

/// GCC vector types for the kernels of this folder, which are compiled for several widths and selected at run time.
/// Everything is inlined into functions with a target attribute and must not be used elsewhere.

#if defined(__x86_64__)
#define URBAN_NAV_X86 1
#endif

#define URBAN_NAV_INLINE __attribute__((always_inline)) inline

// Vectors wider than those of the baseline are passed only between inlined functions, so no call depends on the ABI.
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
