// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "urban_nav_core/image/patch.hpp"

namespace urban_nav_core {
namespace {

constexpr int kWidth = 64;

/// Corner of two edges, blurred by a lens.
std::vector<std::uint8_t> corner(double sigma) {
  const auto edge = [&](double x) { return 0.5 + 0.5 * std::erf(x / (std::sqrt(2.0) * sigma)); };
  std::vector<std::uint8_t> pixels(kWidth * kWidth);
  for (int v = 0; v < kWidth; ++v)
    for (int u = 0; u < kWidth; ++u)
      pixels[static_cast<std::size_t>(v * kWidth + u)] =
          static_cast<std::uint8_t>(std::lround(40.0 + 160.0 * edge(u - 32.8) * edge(v - 33.3)));
  return pixels;
}

ImageView viewOfPixels(const std::vector<std::uint8_t>& pixels) { return {pixels.data(), kWidth, kWidth, kWidth}; }

// Blur moves a corner into its bright side, and an equally blurred template moves along.
TEST(PatchBlur, TakesTheDisplacementOfACornerAway) {
  const std::vector<std::uint8_t> sharp = corner(0.6), soft = corner(std::sqrt(0.36 + 1.0));
  const auto source = cutSource(viewOfPixels(sharp), 32, 32);
  ASSERT_TRUE(source);
  PatchTemplate as_it_was, as_blurred;
  ASSERT_TRUE(warpTemplate(*source, {}, as_it_was));
  ASSERT_TRUE(warpTemplate(blurred(*source, {1.0, 1.0}), {}, as_blurred));
  const Alignment wrong = alignPatch(viewOfPixels(soft), as_it_was, {32.0, 32.0}),
                  right = alignPatch(viewOfPixels(soft), as_blurred, {32.0, 32.0});
  ASSERT_TRUE(wrong.converged && right.converged);
  const Eigen::Vector2d middle(32.0, 32.0);
  EXPECT_GT((wrong.position - middle).norm(), 0.1);
  EXPECT_LT((right.position - middle).norm(), 0.02);
  const Eigen::Vector2d predicted = displacement(as_blurred, as_it_was);
  EXPECT_NEAR(predicted.norm(), (wrong.position - middle).norm(), 0.6 * predicted.norm());
}

TEST(PatchBlur, OfNothingChangesNothing) {
  const std::vector<std::uint8_t> sharp = corner(0.6);
  const auto source = cutSource(viewOfPixels(sharp), 32, 32);
  EXPECT_EQ(blurred(*source, Eigen::Vector2d::Zero()).pixels, source->pixels);
}

}  // namespace
}  // namespace urban_nav_core
