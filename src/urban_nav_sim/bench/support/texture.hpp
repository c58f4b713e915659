// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace urban_nav_sim::bench {

/// What a picture is made of, by figures that a flat, a noisy or a toy one has wrong.
struct Texture {
  double textured_blocks = 0.0;  ///< share of the blocks of 16x16 pixels whose mean gradient is over 2.5 levels a pixel
  double corners = 0.0;          ///< FAST corners (threshold 20) in 512x384 pixels
  double two_octaves_up = 0.0;   ///< mean gradient of the picture at a quarter of its size, over that at full size
  double above = 0.0, below = 0.0;  ///< the same ratio of the upper and of the lower half: walls and ground, mostly
  double white = 0.0;               ///< share of pixels of 250 levels and more
  double noise = 0.0;               ///< grey levels, least decile of the blocks that are neither black nor white
  std::vector<double> gradients;    ///< log2(1 + gradient in levels a pixel), of every 61st pixel
};

/// `image`: 8 bit, grey. Noise as Immerkaer 1996: what is left of each pixel after planes are taken away.
Texture measureTexture(const cv::Mat& image);

}  // namespace urban_nav_sim::bench
