// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/repeated_images.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace urban_nav_input {
namespace {

using urban_nav_core::StereoPair;

/// `picture`: which scene the left and the right camera show in the i-th pair.
std::string examine(int pairs, const std::function<std::pair<int, int>(int)>& picture) {
  constexpr int kWidth = 16, kHeight = 8;
  std::vector<std::vector<std::uint8_t>> pixels;
  pixels.reserve(static_cast<std::size_t>(2 * pairs));
  const auto view = [&](int scene) {
    std::vector<std::uint8_t>& bytes = pixels.emplace_back(static_cast<std::size_t>(kWidth * kHeight));
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i + i * i / 3);
    bytes.back() = static_cast<std::uint8_t>(scene);  // equal but for the last pixel
    return urban_nav_core::ImageView{bytes.data(), kWidth, kHeight, kWidth};
  };
  RepeatedImages repeated;
  StereoPair before;
  for (int i = 0; i < pairs; ++i) {
    const auto [left, right] = picture(i);
    StereoPair now{1'500'000'000'000'000'000 + i * 50'000'000, view(left), view(right)};
    if (i > 0) repeated.add(before, now);
    before = now;
  }
  std::string text;
  for (const Finding& finding : repeated.findings()) {
    EXPECT_FALSE(finding.remedy.empty());
    text += finding.text + "\n";
  }
  return text;
}

TEST(RepeatedImages, FindsNothingWhereImagesChange) {
  EXPECT_EQ(examine(60, [](int i) { return std::make_pair(i, i); }), "");
  EXPECT_EQ(examine(60, [](int i) { return std::make_pair(i == 30 ? 29 : i, i); }), "") << "one image";
  EXPECT_EQ(examine(60, [](int i) { return std::make_pair(std::max(i, 12), std::max(i, 12)); }), "")
      << "a simulated robot that waits for half a second";
}

TEST(RepeatedImages, NamesTheCameraThatIsFrozen) {
  const std::string right = examine(8, [](int i) { return std::make_pair(i, std::min(i, 3)); });
  EXPECT_NE(right.find("4 of 8 right images repeat"), std::string::npos) << right;
  const std::string left = examine(60, [](int i) { return std::make_pair(i - i % 2, i); });
  EXPECT_NE(left.find("30 of 60 left images repeat"), std::string::npos) << left;
}

TEST(RepeatedImages, NamesPairsThatArePublishedTwiceAndCamerasThatAreFrozen) {
  const std::string twice = examine(60, [](int i) { return std::make_pair(i / 2, i / 2); });
  EXPECT_NE(twice.find("more than once"), std::string::npos) << twice;
  const std::string frozen = examine(60, [](int i) { return std::make_pair(std::min(i, 20), std::min(i, 20)); });
  EXPECT_NE(frozen.find("frozen"), std::string::npos) << frozen;
}

}  // namespace
}  // namespace urban_nav_input
