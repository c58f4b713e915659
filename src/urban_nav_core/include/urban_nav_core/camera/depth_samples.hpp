// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace urban_nav_core {

/// Subsampled disparities of a rectified stereo camera, row by row. All vectors have width * height elements.
struct DepthSamples {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px, of the full left image
  double baseline = 0.0;                          ///< m
  int step = 1;                                   ///< px of the full image, between samples along rows and columns
  int width = 0, height = 0;                      ///< samples
  std::vector<float> disparity;                   ///< px of the full image, 0 at infinity; 0: no measurement
  std::vector<float> sigma;                       ///< px, standard deviation; 0 without a measurement
  std::vector<std::uint8_t> grey;                 ///< grey level of the left image
};

}  // namespace urban_nav_core
