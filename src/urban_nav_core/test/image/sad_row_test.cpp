// SPDX-License-Identifier: BSD-3-Clause
#include "image/sad_row.hpp"

#include <gtest/gtest.h>

#include <random>

#include "urban_nav_core/image/patch.hpp"

namespace urban_nav_core {
namespace {

/// Covers the whole range of grey levels, so that sums reach their largest values.
std::vector<std::uint8_t> drawPixels(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < width * height; ++i)
    pixels.push_back(random() % 3 == 0 ? 255 : random() % 2 == 0 ? 0 : static_cast<std::uint8_t>(random()));
  return pixels;
}

TEST(SadRow, IsTheSumPlaceByPlaceWithEveryInstructionSet) {
  constexpr int kWidth = 60, kHeight = 9;
  const std::vector<std::uint8_t> a = drawPixels(kWidth, kHeight, 1), b = drawPixels(kWidth, kHeight, 2);
  const ImageView left{a.data(), kWidth, kHeight, kWidth}, right{b.data(), kWidth, kHeight, kWidth};
  const SadPatch patch = sadPatch(left, 20, 4);
  for (const auto& set : sad_row::instructionSets())
    for (int u = 4; u + set.lanes - 1 + 3 < kWidth; ++u) {
      std::vector<int> sads(static_cast<std::size_t>(set.lanes));
      set.compare(patch.value.data(), right.row(0) + u - 4, right.stride, sads.data());
      for (int i = 0; i < set.lanes; ++i)
        EXPECT_EQ(sads[static_cast<std::size_t>(i)], meanRemovedSad(patch, right, u + i, 4))
            << set.name << ' ' << u + i;
    }
}

TEST(SadRow, HasAnyLength) {
  constexpr int kWidth = 60, kHeight = 9;
  const std::vector<std::uint8_t> pixels = drawPixels(kWidth, kHeight, 3);
  const ImageView image{pixels.data(), kWidth, kHeight, kWidth};
  const SadPatch patch = sadPatch(image, 20, 4);
  for (int count = 0; count <= kWidth - 7; ++count) {
    std::vector<int> sads(static_cast<std::size_t>(count) + 1, -1);
    meanRemovedSads(patch, image, 4, 4, count, sads.data());
    for (int i = 0; i < count; ++i)
      ASSERT_EQ(sads[static_cast<std::size_t>(i)], meanRemovedSad(patch, image, 4 + i, 4)) << count << ' ' << i;
    EXPECT_EQ(sads.back(), -1);
  }
}

}  // namespace
}  // namespace urban_nav_core
