// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"
#include "urban_nav_core/image/view.hpp"

namespace fabmap_node::testing {

inline constexpr int kBlocksWidth = 240, kBlocksHeight = 180;

/// Returns the pixels of an image of rectangles of random size and grey level, shifted right by `shift` px (at most 6).
inline std::vector<std::uint8_t> drawBlocks(unsigned seed, int shift = 0) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> pixels(kBlocksWidth * kBlocksHeight, 90);
  for (int k = 0; k < 120; ++k) {
    const int u = static_cast<int>(random() % (kBlocksWidth - 20)) + shift;
    const int v = static_cast<int>(random() % (kBlocksHeight - 20));
    const int w = 4 + static_cast<int>(random() % 14), h = 4 + static_cast<int>(random() % 14);
    const auto grey = static_cast<std::uint8_t>(random() % 256);
    for (int j = v; j < v + h; ++j)
      for (int i = u; i < u + w && i < kBlocksWidth; ++i) pixels[static_cast<std::size_t>(j * kBlocksWidth + i)] = grey;
  }
  return pixels;
}

inline urban_nav_core::ImageView viewOfBlocks(const std::vector<std::uint8_t>& pixels) {
  return {pixels.data(), kBlocksWidth, kBlocksHeight, kBlocksWidth};
}

inline void expectInside(const PlaceFeature& feature) {
  EXPECT_GE(feature.u, 0.0F);
  EXPECT_LE(feature.u, 1.0F);
  EXPECT_GE(feature.v, 0.0F);
  EXPECT_LE(feature.v, 1.0F);
}

inline int squaredLength(const PlaceFeature& feature) {
  int squares = 0;
  for (const std::uint8_t x : feature.descriptor) squares += x * x;
  return squares;
}

}  // namespace fabmap_node::testing
