// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace scene_labeler {

/// Returns the effective number of `count` log probabilities with correlated errors, the factor of their mean: count if
/// independent (correlation 0), 1 if equal (correlation 1).
inline double effectiveCount(std::size_t count, double correlation) {
  const auto n = static_cast<double>(count);
  return n / (1.0 + (n - 1.0) * correlation);
}

}  // namespace scene_labeler
