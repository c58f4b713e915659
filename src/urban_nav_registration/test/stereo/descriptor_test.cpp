// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/stereo/descriptor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pyramid;

/// An image of a function of position.
Pyramid toPicture(const std::function<double(double, double)>& grey) {
  std::vector<std::uint8_t> pixels(200 * 160);
  for (int v = 0; v < 160; ++v)
    for (int u = 0; u < 200; ++u)
      pixels[static_cast<std::size_t>(v * 200 + u)] = static_cast<std::uint8_t>(std::lround(grey(u, v)));
  Pyramid pyramid(4);
  pyramid.build({pixels.data(), 200, 160, 200});
  return pyramid;
}

double scene(double x, double y) {
  return 110.0 + 40.0 * std::sin(0.31 * x + 0.1 * y) * std::cos(0.23 * y) +
         30.0 * std::sin(0.13 * x * 0.7 - 0.21 * y + 1.0);
}

double distanceBetween(const Pyramid& a, const Eigen::Vector2d& at_a, double window_a, const Pyramid& b,
                       const Eigen::Vector2d& at_b, double window_b) {
  return static_cast<double>((describe(a, at_a, window_a) - describe(b, at_b, window_b)).norm());
}

TEST(Descriptor, IsAUnitVectorThatLightDoesNotChange) {
  const Pyramid plain = toPicture(scene),
                other = toPicture([](double x, double y) { return 0.6 * scene(x, y) + 40.0; });
  EXPECT_NEAR(describe(plain, {100.0, 80.0}, 32.0).norm(), 1.0F, 1e-5F);
  EXPECT_LT(distanceBetween(plain, {100.0, 80.0}, 32.0, other, {100.0, 80.0}, 32.0), 0.05);
  EXPECT_GT(distanceBetween(plain, {100.0, 80.0}, 32.0, plain, {125.0, 70.0}, 32.0), 0.5);
}

TEST(Descriptor, FollowsTheScaleThatIsGiven) {
  const Pyramid near = toPicture(scene), far = toPicture([](double x, double y) {
                                           return scene(100.0 + 1.7 * (x - 100.0), 80.0 + 1.7 * (y - 80.0));
                                         });
  EXPECT_LT(distanceBetween(near, {100.0, 80.0}, 51.0, far, {100.0, 80.0}, 30.0), 0.25);
  EXPECT_GT(distanceBetween(near, {100.0, 80.0}, 40.0, far, {100.0, 80.0}, 40.0), 0.4);
}

TEST(Descriptor, AUniformPatchIsZeroAndMatchesNothing) {
  const Pyramid flat = toPicture([](double, double) { return 90.0; });
  EXPECT_EQ(describe(flat, {100.0, 80.0}, 32.0).norm(), 0.0F);
  Descriptors zeros = Descriptors::Zero(kDescriptorSize, 5);
  EXPECT_TRUE(mutualNearest(zeros, zeros).empty());
  EXPECT_TRUE(mutualNearest(Descriptors(kDescriptorSize, 0), zeros).empty());
}

TEST(Descriptor, BordersAndCornersAreReadToo) {
  const Pyramid picture = toPicture(scene);
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0, 0), Eigen::Vector2d(199, 159), Eigen::Vector2d(0, 159)})
    EXPECT_TRUE(describe(picture, at, 130.0).allFinite());
}

TEST(MutualNearest, PairsEqualOnesAndSkipsAmbiguousOnes) {
  Descriptors a = Descriptors::Zero(kDescriptorSize, 4), b = Descriptors::Zero(kDescriptorSize, 4);
  a(0, 0) = a(1, 1) = a(2, 2) = a(3, 3) = 1.0F;
  b(2, 0) = b(0, 1) = 1.0F;
  b(3, 2) = b(3, 3) = 1.0F;  // two equal candidates: ambiguous
  const auto pairs = mutualNearest(a, b);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].a, 0);
  EXPECT_EQ(pairs[0].b, 1);
  EXPECT_EQ(pairs[1].a, 2);
  EXPECT_EQ(pairs[1].b, 0);
}

}  // namespace
}  // namespace urban_nav_registration
