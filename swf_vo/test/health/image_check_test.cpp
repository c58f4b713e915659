// SPDX-License-Identifier: BSD-3-Clause
#include "health/image_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace swf_vo {
namespace {

using urban_nav_core::ImageView;
using urban_nav_core::StereoPair;

constexpr int kCheckedWidth = 512, kCheckedHeight = 384;

/// A wall of random blobs at one disparity in both cameras, with independent noise in every frame.
struct CheckScene {
  std::vector<std::uint8_t> left, right;

  CheckScene(unsigned seed, double disparity, double gain = 1.0, double shift = 0.0, double softness = 1.0)
      : left(kCheckedWidth * kCheckedHeight), right(kCheckedWidth * kCheckedHeight) {
    std::mt19937 noise(seed);
    std::normal_distribution<double> grey(0.0, 1.0);
    for (int v = 0; v < kCheckedHeight; ++v)
      for (int u = 0; u < kCheckedWidth; ++u) {
        left[static_cast<std::size_t>(v * kCheckedWidth + u)] =
            clip(gain * value(u + shift, v, softness) + grey(noise));
        right[static_cast<std::size_t>(v * kCheckedWidth + u)] =
            clip(gain * value(u + shift + disparity, v, softness) + grey(noise));
      }
  }
  StereoPair pair(std::int64_t stamp = 0) const {
    return {stamp,
            {left.data(), kCheckedWidth, kCheckedHeight, kCheckedWidth},
            {right.data(), kCheckedWidth, kCheckedHeight, kCheckedWidth}};
  }
  StereoPair exchanged() const { return {0, pair().right, pair().left}; }

  static std::uint8_t clip(double grey) { return static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0)); }
  static double value(double u, double v, double softness) {
    const double coarse =
        std::sin(0.11 * u + 2.0 * std::sin(0.037 * v)) + std::sin(0.071 * u + 0.13 * v + std::sin(0.017 * u * 1.3));
    const double fine = std::sin(0.9 * u + 0.3 * v) + std::sin(0.7 * v - 0.4 * u);
    return 60.0 + 15.0 * coarse + 8.0 * softness * fine;
  }
};

TEST(ImageCheck, PassesUsualPairs) {
  ImageCheck check;
  for (unsigned i = 0; i < 5; ++i) {
    const ImageVerdict verdict = check.check(CheckScene(i, 12.0, 1.0, 3.0 * i).pair(), true);
    EXPECT_TRUE(verdict.usable);
    EXPECT_FALSE(verdict.exchange);
    EXPECT_EQ(verdict.reason, Reason::None) << toString(verdict.reason);
  }
}

// Sudden saturation of half of the image: unusable, until it lasts and becomes the reference.
TEST(ImageCheck, WaitsForTheLightToComeBack) {
  ImageCheck check;
  for (unsigned i = 0; i < 5; ++i) EXPECT_TRUE(check.check(CheckScene(i, 12.0, 1.0, 3.0 * i).pair(), true).usable);
  unsigned frame = 5;
  const std::vector<CheckScene> seen = {CheckScene(5, 12.0, 4.5, 15.0), CheckScene(6, 12.0, 4.5, 18.0),
                                        CheckScene(7, 12.0, 4.5, 21.0)};
  const auto white = [&] { return check.check(seen[frame % 3].pair(), false); };
  for (; frame < 25; ++frame) {
    const ImageVerdict verdict = white();
    EXPECT_FALSE(verdict.usable) << frame;
    EXPECT_EQ(verdict.reason, Reason::ExposureJump) << toString(verdict.reason);
  }
  bool taken = false;
  for (; frame < 150 && !taken; ++frame) taken = white().usable;
  EXPECT_TRUE(taken);
}

TEST(ImageCheck, NamesAMissingImageAndImagesOfOtherSize) {
  const CheckScene scene(1, 12.0);
  ImageCheck check;
  StereoPair pair = scene.pair();
  pair.right = ImageView();
  EXPECT_EQ(check.check(pair, false).reason, Reason::ImageMissing);
  pair = scene.pair();
  pair.right.height -= 2;
  EXPECT_EQ(check.check(pair, false).reason, Reason::ImageMissing);
  EXPECT_FALSE(check.check(pair, false).usable);
}

TEST(ImageCheck, NamesBlackAndWashedOutImages) {
  ImageCheck check;
  check.check(CheckScene(1, 12.0).pair(), false);
  EXPECT_EQ(check.check(CheckScene(2, 12.0, 0.0).pair(), false).reason, Reason::Dark);
  EXPECT_EQ(check.check(CheckScene(3, 12.0, 1000.0).pair(), false).reason, Reason::Dark);
  EXPECT_EQ(check.check(CheckScene(4, 12.0).pair(), false).reason, Reason::None);
}

TEST(ImageCheck, NamesAFrozenCameraEvenIfOnlyOneIs) {
  ImageCheck check;
  const CheckScene first(1, 12.0), second(2, 12.0);
  check.check(first.pair(), false);
  StereoPair half = second.pair();
  half.right = first.pair().right;
  EXPECT_EQ(check.check(half, false).reason, Reason::Frozen);
  EXPECT_EQ(check.check(half, false).reason, Reason::Frozen);
  EXPECT_EQ(check.check(CheckScene(3, 12.0).pair(), false).reason, Reason::None)
      << "the same scene with fresh noise is not frozen";
}

TEST(ImageCheck, NamesAJumpOfExposureOnceAndThenGetsUsedToIt) {
  ImageCheck check;
  for (unsigned i = 0; i < 5; ++i) check.check(CheckScene(i, 12.0).pair(), false);
  EXPECT_EQ(check.check(CheckScene(10, 12.0, 2.2).pair(), false).reason, Reason::ExposureJump);
  for (unsigned i = 0; i < 10; ++i) check.check(CheckScene(20 + i, 12.0, 2.2).pair(), false);
  EXPECT_EQ(check.check(CheckScene(40, 12.0, 2.2).pair(), false).reason, Reason::None);
}

/// The scene with stepped grey levels, so that it has edges; then blurred over 5 x 5 pixels, `times` times.
CheckScene stepped(unsigned seed, int times) {
  CheckScene scene(seed, 12.0, 1.0, 3.0 * seed, 0.0);
  for (auto* image : {&scene.left, &scene.right}) {
    for (std::uint8_t& grey : *image) grey = static_cast<std::uint8_t>(grey / 24 * 24);
    for (int i = 0; i < 2 * times; ++i) {
      const std::vector<std::uint8_t> before = *image;
      const std::size_t step = i % 2 == 0 ? 1 : kCheckedWidth;
      for (std::size_t at = 2 * step; at + 2 * step < before.size(); ++at)
        (*image)[at] = static_cast<std::uint8_t>(
            (before[at - 2 * step] + before[at - step] + before[at] + before[at + step] + before[at + 2 * step] + 2) /
            5);
    }
  }
  return scene;
}

TEST(ImageCheck, NamesBlurAndGetsUsedToIt) {
  ImageCheck check;
  for (unsigned i = 0; i < 5; ++i) EXPECT_EQ(check.check(stepped(i, 0).pair(), false).reason, Reason::None) << i;
  const ImageVerdict verdict = check.check(stepped(5, 2).pair(), false);
  EXPECT_EQ(verdict.reason, Reason::Blurred);
  EXPECT_TRUE(verdict.usable);
  EXPECT_GT(verdict.edges.left.minCoeff(), 2.0);
  unsigned frames = 6;
  const std::vector<CheckScene> seen = {stepped(6, 2), stepped(7, 2), stepped(8, 2)};
  while (frames < 100 && check.check(seen[frames % 3].pair(), false).reason == Reason::Blurred) ++frames;
  EXPECT_GT(frames, 30U);
  EXPECT_LT(frames, 100U);
}

TEST(ImageCheck, DoesNotTakeOneSoftImageForBlur) {
  ImageCheck check;
  for (unsigned i = 0; i < 5; ++i) check.check(stepped(i, 0).pair(), false);
  CheckScene one_soft = stepped(5, 0);
  one_soft.right = stepped(5, 2).right;
  EXPECT_EQ(check.check(one_soft.pair(), false).reason, Reason::None);
}

TEST(ImageCheck, FindsExchangedImagesAtTheStartAndLater) {
  ImageCheck fresh;
  EXPECT_TRUE(fresh.check(CheckScene(1, 14.0).exchanged(), false).exchange);
  ImageCheck running;
  for (unsigned i = 0; i < 3; ++i) running.check(CheckScene(i, 14.0).pair(), false);
  const ImageVerdict verdict = running.check(CheckScene(7, 14.0).exchanged(), true);
  EXPECT_TRUE(verdict.exchange);
  EXPECT_TRUE(verdict.usable) << "usable after swapping";
  EXPECT_EQ(verdict.reason, Reason::Swapped);
}

}  // namespace
}  // namespace swf_vo
