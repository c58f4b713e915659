// SPDX-License-Identifier: BSD-3-Clause
#include "image/fast_score.hpp"

#include <gtest/gtest.h>

#include <random>

namespace urban_nav_core::fast_score {
namespace {

/// Grey levels that change from pixel to pixel by about `step`: with a large one nearly all pixels are candidates.
std::vector<std::uint8_t> picture(int stride, int rows, int step, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < stride * rows; ++i)
    pixels.push_back(static_cast<std::uint8_t>(static_cast<int>(random()) % (step + 1) + (i / 5 % 7 == 0 ? 90 : 20)));
  return pixels;
}

TEST(FastScore, IsTheSameWithEveryInstructionSetAndTouchesNoOtherPixel) {
  const auto sets = instructionSets();
  EXPECT_STREQ(sets.back().name, "baseline");
  constexpr int kStride = 150, kRows = 7, kBegin = 3;
  for (const int step : {0, 6, 40, 150}) {
    const std::vector<std::uint8_t> pixels = picture(kStride, kRows, step, static_cast<unsigned>(step));
    for (const int end : {3, 4, 18, 19, 34, 35, 36, 67, 147})
      for (const int threshold : {0, 4, 12, 60}) {
        std::vector<std::uint8_t> expected(kStride, 7);
        const bool any =
            sets.back().scoreRow(pixels.data() + 3 * kStride, kStride, kBegin, end, threshold, expected.data());
        for (int u = 0; u < kStride; ++u) {
          const bool outside = u < kBegin || u >= end;
          EXPECT_TRUE(!outside || expected[static_cast<std::size_t>(u)] == 7) << u;
        }
        for (const InstructionSet& set : sets) {
          std::vector<std::uint8_t> scores(kStride, 7);
          EXPECT_EQ(set.scoreRow(pixels.data() + 3 * kStride, kStride, kBegin, end, threshold, scores.data()), any)
              << set.name;
          EXPECT_EQ(scores, expected) << set.name << ", step " << step << ", end " << end << ", threshold "
                                      << threshold;
        }
      }
  }
}

}  // namespace
}  // namespace urban_nav_core::fast_score
