// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace urban_nav::testing {

/// Grey image (512x384) of a drawn scene: rectangles and discs at random positions, moved by `shift` px.
inline cv::Mat sceneImage(unsigned scene, int shift = 0) {
  std::mt19937 random(9000 + scene);
  const auto draw = [&random](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  cv::Mat image(384, 512, CV_8UC1, cv::Scalar(120));
  for (int i = 0; i < 160; ++i) {
    const int x = draw(512) + shift, y = draw(384), grey = 30 + draw(200), size = 4 + draw(20), width = 8 + draw(50);
    if (i % 2 == 0) cv::rectangle(image, {x, y, width, 2 * size}, cv::Scalar(grey), cv::FILLED);
    else cv::circle(image, {x, y}, size, cv::Scalar(grey), cv::FILLED);
  }
  return image;
}

}  // namespace urban_nav::testing
