// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

#include "padded.hpp"
#include "sgm/descriptors.hpp"

namespace dense_stereo::testing_support {

/// Independent grey levels, rows extended.
inline Padded<std::uint8_t> noiseImage(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Padded<std::uint8_t> image;
  image.resize(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) image.row(v)[u] = static_cast<std::uint8_t>(random() % 256);
  extendRows(image);
  return image;
}

/// The left image of a scene at one disparity: left(u) = right(u - shift).
inline Padded<std::uint8_t> shiftedImage(const Padded<std::uint8_t>& right, int shift) {
  Padded<std::uint8_t> left;
  left.resize(right.width(), right.height());
  for (int v = 0; v < right.height(); ++v)
    for (int u = 0; u < right.width(); ++u) left.row(v)[u] = right.row(v)[std::max(u - shift, 0)];
  extendRows(left);
  return left;
}

}  // namespace dense_stereo::testing_support
