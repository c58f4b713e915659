// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace urban_nav_sim::bench {

/// Texture statistics of a picture, which distinguish flat, noisy and synthetic ones.
struct Texture {
  double textured_blocks = 0.0;  ///< share of the blocks of 16x16 pixels whose mean gradient is over 2.5 levels a pixel
  double corners = 0.0;          ///< FAST corners (threshold 20) in 512x384 pixels
  double two_octaves_up = 0.0;   ///< mean gradient of the picture at a quarter of its size, over that at full size
  double above = 0.0,
         below = 0.0;             ///< ratio of mean gradients of the upper and the lower half: mostly walls and ground
  double white = 0.0;             ///< share of pixels of 250 levels and more
  double noise = 0.0;             ///< grey levels, least decile of the blocks that are neither black nor white
  std::vector<double> gradients;  ///< log2(1 + gradient in levels a pixel), of every 61st pixel
};

/// `image`: 8 bit, grey. Noise by Immerkaer 1996: residual of each pixel after removal of planes.
Texture measureTexture(const cv::Mat& image);

}  // namespace urban_nav_sim::bench
