// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace dense_stereo {

/// Disparities of the left image, row by row, with the variance of each.
struct DisparityImage {
  static constexpr float kInvalid = -1.0F;

  int width = 0, height = 0;
  std::vector<float> disparity;  ///< px, u_left - u_right; `kInvalid` for unmatched pixels
  std::vector<float> variance;   ///< px^2, positive; 0 where the disparity is invalid

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  bool isValid(int u, int v) const { return disparity[index(u, v)] >= 0.0F; }
};

}  // namespace dense_stereo
