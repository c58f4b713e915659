// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace scene_labeler {

/// Returns by how much the mean of `count` log probabilities is multiplied when their errors correlate: count if they
/// are independent (correlation 0), 1 if they are equal (correlation 1).
inline double effectiveCount(std::size_t count, double correlation) {
  const auto n = static_cast<double>(count);
  return n / (1.0 + (n - 1.0) * correlation);
}

}  // namespace scene_labeler
