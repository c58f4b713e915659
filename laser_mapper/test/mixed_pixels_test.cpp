// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/mixed_pixels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace laser_mapper {
namespace {

using urban_nav_core::Scan;

constexpr double kStep = 0.5 * M_PI / 180.0;

/// A scan whose range is a function of the angle.
template <typename Range>
Scan scanWith(const Range& range) {
  Scan scan;
  for (int i = 0; i < 181; ++i) {
    const double angle = -M_PI / 4.0 + kStep * i;
    urban_nav_core::Beam beam;
    beam.direction = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
    beam.range = static_cast<float>(range(angle));
    scan.beams.push_back(beam);
  }
  return scan;
}

int countMixed(const Scan& scan) {
  const auto flags = findMixedPixels(scan, MixedPixelModel());
  return std::accumulate(flags.begin(), flags.end(), 0);
}

TEST(MixedPixels, PlanesHaveNoneAtAnyIncidence) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.006);
  for (const double tilt : {0.0, 0.3, 0.6, 0.75}) {
    const Scan wall = scanWith([&](double angle) { return 2.0 / std::cos(angle - tilt) + noise(random); });
    EXPECT_EQ(countMixed(wall), 0) << tilt;
  }
}

TEST(MixedPixels, FlatGroundFarAwayHasNone) {
  const Scan ground = scanWith([](double angle) { return angle < -0.03 ? 0.75 / std::sin(-angle) : 40.0; });
  const auto flags = findMixedPixels(ground, MixedPixelModel());
  for (std::size_t i = 0; i < 80; ++i) EXPECT_EQ(flags[i], 0) << i;
}

TEST(MixedPixels, ABeamBetweenTwoWallsIsFound) {
  Scan scan = scanWith([](double angle) { return (angle < 0.1 ? 4.0 : 5.0) / std::cos(angle); });
  std::size_t edge = 90;
  while (scan.beams[edge + 1].range < 4.5F) ++edge;
  scan.beams[edge].range = 4.4F;
  const auto flags = findMixedPixels(scan, MixedPixelModel());
  EXPECT_EQ(countMixed(scan), 1);
  EXPECT_EQ(flags[edge], 1);
}

TEST(MixedPixels, EdgesAndThinObjectsAreKept) {
  Scan scan = scanWith([](double angle) { return (angle < 0.1 ? 4.0 : 5.0) / std::cos(angle); });
  EXPECT_EQ(countMixed(scan), 0);
  scan.beams[40].range = 2.0F;  // a pole before the wall
  EXPECT_EQ(countMixed(scan), 0);
}

TEST(MixedPixels, ScansOfFewBeamsHaveNone) {
  EXPECT_TRUE(findMixedPixels(Scan(), MixedPixelModel()).empty());
  Scan scan = scanWith([](double) { return 3.0; });
  scan.beams.resize(3);
  EXPECT_EQ(countMixed(scan), 0);
}

}  // namespace
}  // namespace laser_mapper
