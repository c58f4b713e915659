// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <random>

namespace fabmap_node::testing {

/// Squares of random brightness, unique to a place and camera.
inline cv::Mat drawSquares(unsigned place, unsigned camera) {
  std::mt19937 random(100 * place + camera);
  cv::Mat grid(24, 32, CV_8UC1), image(240, 320, CV_8UC1);
  for (int v = 0; v < grid.rows; ++v)
    for (int u = 0; u < grid.cols; ++u) grid.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random() % 256);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) image.at<std::uint8_t>(v, u) = grid.at<std::uint8_t>(v / 10, u / 10);
  return image;
}

}  // namespace fabmap_node::testing
