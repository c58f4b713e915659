// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/exchanged.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace urban_nav_core {
namespace {

constexpr int kExchangedWidth = 512, kExchangedHeight = 384;

/// Random blobs of 8x3 px, `shift` px further to the left.
std::vector<std::uint8_t> blobs(int shift) {
  std::vector<std::uint8_t> pixels;
  for (int v = 0; v < kExchangedHeight; ++v)
    for (int u = 0; u < kExchangedWidth; ++u) {
      std::mt19937 level(static_cast<unsigned>((u + shift + 800) / 8 + 1000 * (v / 3)));
      pixels.push_back(static_cast<std::uint8_t>(level() % 200 + 20));
    }
  return pixels;
}

ImageView greyView(const std::vector<std::uint8_t>& pixels) {
  return {pixels.data(), kExchangedWidth, kExchangedHeight, kExchangedWidth};
}

TEST(LooksExchanged, IsTrueForNegativeDisparitiesOnly) {
  const std::vector<std::uint8_t> left = blobs(0), right = blobs(24);
  EXPECT_FALSE(looksExchanged(greyView(left), greyView(right)));
  EXPECT_TRUE(looksExchanged(greyView(right), greyView(left)));
}

TEST(LooksExchanged, IsFalseWithoutEvidence) {
  const std::vector<std::uint8_t> far = blobs(0), flat(kExchangedWidth * kExchangedHeight, 90);
  EXPECT_FALSE(looksExchanged(greyView(far), greyView(far))) << "all disparities are zero";
  EXPECT_FALSE(looksExchanged(greyView(flat), greyView(flat)));
  const ImageView tiny{flat.data(), 20, 20, kExchangedWidth};
  EXPECT_FALSE(looksExchanged(tiny, tiny));
}

}  // namespace
}  // namespace urban_nav_core
