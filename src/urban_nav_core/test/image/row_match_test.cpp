// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/row_match.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace urban_nav_core {
namespace {

struct RowPicture {
  int width = 160, height = 40;
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(160 * 40, 100);
  ImageView view() const { return {pixels.data(), width, height, width}; }
  std::uint8_t& at(int u, int v) { return pixels[static_cast<std::size_t>(v * width + u)]; }
};

/// Random blocks of 2x2 px, the right one shifted by `disparity` to the left.
void paint(int disparity, unsigned seed, RowPicture& left, RowPicture& right) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> blocks(20 * 200);
  for (auto& b : blocks) b = static_cast<std::uint8_t>(random() % 200);
  const auto grey = [&](int u, int v) { return blocks[static_cast<std::size_t>((v / 2) * 200 + (u + 100) / 2)]; };
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 160; ++u) {
      left.at(u, v) = grey(u, v);
      right.at(u, v) = static_cast<std::uint8_t>(20 + grey(u + disparity, v));
    }
}

TEST(FindDisparity, FindsItInSpiteOfBrightness) {
  for (const int disparity : {-2, 0, 1, 7, 30, 60}) {
    RowPicture left, right;
    paint(disparity, 3, left, right);
    const auto found = findDisparity(left.view(), right.view(), 100, 20, -2, 64);
    ASSERT_TRUE(found) << disparity;
    EXPECT_EQ(*found, disparity);
  }
}

TEST(FindDisparity, SearchesTheGivenRow) {
  RowPicture left, right, lower;
  paint(7, 3, left, right);
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 160; ++u) lower.at(u, v) = right.at(u, std::max(0, v - 3));
  EXPECT_FALSE(findDisparity(left.view(), lower.view(), 100, 20, -2, 64));
  const auto found = findDisparity(left.view(), lower.view(), 100, 20, -2, 64, 3);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, 7);
  EXPECT_FALSE(findDisparity(left.view(), lower.view(), 100, 20, -2, 64, 30)) << "outside the image";
}

TEST(FindDisparity, RefusesWhatRepeatsItselfOrIsNotThere) {
  RowPicture left, right;
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 160; ++u)
      left.at(u, v) = right.at(u, v) = static_cast<std::uint8_t>(100 + 50 * ((u / 5 + v / 5) % 2));
  EXPECT_FALSE(findDisparity(left.view(), right.view(), 100, 20, -2, 64));
  RowPicture other, unused;
  paint(0, 1, left, unused);
  paint(0, 2, unused, other);
  EXPECT_FALSE(findDisparity(left.view(), other.view(), 100, 20, -2, 64));
  RowPicture flat;
  EXPECT_FALSE(findDisparity(flat.view(), flat.view(), 100, 20, -2, 64));
  EXPECT_FALSE(findDisparity(left.view(), other.view(), 2, 20, -2, 64));
}

TEST(FindDisparity, StaysWithinTheRangeItWasGiven) {
  RowPicture left, right;
  paint(40, 5, left, right);
  EXPECT_FALSE(findDisparity(left.view(), right.view(), 100, 20, -2, 30));
  EXPECT_TRUE(findDisparity(left.view(), right.view(), 100, 20, -2, 41));
}

}  // namespace
}  // namespace urban_nav_core
