// SPDX-License-Identifier: BSD-3-Clause
#include "noise/smooth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_sim {
namespace {

TEST(SmoothNoise, HasUnitVarianceOnALine) {
  const Noise noise(7, "line");
  double mean = 0.0, square = 0.0;
  constexpr int kMany = 200000;
  for (int i = 0; i < kMany; ++i) {
    const double value = smoothNoise(noise, 0.37 * i - 1000.0);
    mean += value / kMany;
    square += value * value / kMany;
  }
  EXPECT_NEAR(mean, 0.0, 0.02);
  EXPECT_NEAR(square, 1.0, 0.03);
}

TEST(SmoothNoise, HasUnitVarianceInThePlane) {
  const Noise noise(7, "plane");
  double mean = 0.0, square = 0.0;
  constexpr int kSide = 300;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double value = smoothNoise(noise, 0.53 * i - 80.0, 0.71 * j - 100.0);
      mean += value / (kSide * kSide);
      square += value * value / (kSide * kSide);
    }
  }
  EXPECT_NEAR(mean, 0.0, 0.03);
  EXPECT_NEAR(square, 1.0, 0.05);
}

TEST(SmoothNoise, IsTwiceDifferentiableAcrossTheLattice) {
  const Noise noise(7, "joints");
  constexpr double kH = 1e-4;
  const auto second = [&](double x, double y) {
    return (smoothNoise(noise, x + kH, y) - 2.0 * smoothNoise(noise, x, y) + smoothNoise(noise, x - kH, y)) / (kH * kH);
  };
  for (int i = -5; i < 5; ++i) EXPECT_NEAR(second(i - 2 * kH, 0.3), second(i + 2 * kH, 0.3), 0.01);
  for (int i = -5; i < 5; ++i) {
    EXPECT_NEAR(smoothNoise(noise, 0.3, i - 1e-9), smoothNoise(noise, 0.3, i + 1e-9), 1e-7);
    EXPECT_NEAR(smoothNoise(noise, i - 1e-9), smoothNoise(noise, i + 1e-9), 1e-7);
  }
}

}  // namespace
}  // namespace urban_nav_sim
