// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/laser_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_input {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

/// A laser that scans a vertical plane on the left, 0.8 m above base_link, which is 0.2 m above the ground; a wall
/// is 6 m away. `assumed_down`: its y is taken to be down, as that of the laser on the other side is.
LaserGround seeGround(double range_scale, double place_error, bool assumed_down = false) {
  LaserGround ground;
  urban_nav_core::Matrix3d R;
  R << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // x of the laser is left, its y is up
  if (assumed_down) R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  urban_nav_core::PlanarScan scan;
  scan.angle_first = -M_PI / 2.0;
  scan.angle_step = M_PI / 180.0;
  scan.range_max = 80.0;
  for (int i = 0; i <= 180; ++i) {
    const double angle = scan.angle_first + scan.angle_step * i;
    const double to_ground = angle < -0.01 ? 1.0 / -std::sin(angle) : 1e3, to_wall = 6.0 / std::cos(angle);
    scan.ranges.push_back(static_cast<float>(range_scale * std::min({to_ground, to_wall, 70.0})));
  }
  for (int i = 0; i < 100; ++i)
    ground.add(scan, Pose(urban_nav_core::Quaterniond(R), Vector3d(0, 0, 0.8 + place_error)));
  return ground;
}

const std::vector<double> kByStereo = {-0.2, -0.19, -0.22, -0.2, -0.21, -0.18};

TEST(LaserGround, IsAtTheHeightOfStereosInASoundSession) {
  const LaserGround ground = seeGround(1.0, 0.0);
  ASSERT_TRUE(ground.height());
  EXPECT_NEAR(*ground.height(), -0.2, 0.03);
  EXPECT_FALSE(ground.finding("laser_left", "/scan", kByStereo));
  EXPECT_FALSE(LaserGround().finding("laser_left", "/scan", kByStereo));
}

TEST(LaserGround, ContradictsWhereRangesOrThePlaceAreWrong) {
  const auto scaled = seeGround(1.5, 0.0).finding("laser_left", "/scan", kByStereo);
  ASSERT_TRUE(scaled);
  EXPECT_NE(scaled->remedy.find("input.laser_left_range_scale=0.66"), std::string::npos) << scaled->remedy;
  const auto moved = seeGround(1.0, 0.4).finding("laser_left", "/scan", kByStereo);
  ASSERT_TRUE(moved);
  EXPECT_NE(moved->text.find("0.4 m too high"), std::string::npos) << moved->text;
  EXPECT_FALSE(seeGround(1.5, 0.0).finding("laser_left", "/scan", {-0.2, 0.3, -0.9, 0.5, 1.0, -1.5})) << "scattered";
}

TEST(LaserGround, RangesInFeetAreRepaired) {
  const auto feet = seeGround(1.0 / 0.3048, 0.0).finding("laser_left", "/scan", kByStereo);
  ASSERT_TRUE(feet);
  EXPECT_NE(feet->text.find("in feet"), std::string::npos) << feet->text;
  EXPECT_EQ(feet->options, (std::vector<std::string>{"--set", "input.laser_left_range_scale=0.3048"}));
  EXPECT_EQ(seeGround(1.0 / 0.3048, 0.0).finding("laser_left", "/scan", kByStereo, 2.0)->options[1],
            "input.laser_left_range_scale=0.6096")
      << "as it is read by another scale";
  EXPECT_TRUE(seeGround(2.0, 0.0).finding("laser_left", "/scan", kByStereo)->options.empty());
}

TEST(LaserGround, ShowsThatTwoLasersAreExchanged) {
  const LaserGround right_place = seeGround(1.0, 0.0), wrong_place = seeGround(1.0, 0.0, true);
  EXPECT_TRUE(areExchanged({wrong_place, wrong_place}, {right_place, right_place}, kByStereo));
  EXPECT_FALSE(areExchanged({right_place, right_place}, {wrong_place, wrong_place}, kByStereo));
  EXPECT_FALSE(areExchanged({right_place, wrong_place}, {wrong_place, right_place}, kByStereo)) << "one sees it";
  EXPECT_FALSE(areExchanged({right_place, right_place}, {right_place, right_place}, kByStereo)) << "the same place";
  EXPECT_FALSE(areExchanged({wrong_place, wrong_place}, {right_place, right_place}, {})) << "stereo sees no ground";
  EXPECT_FALSE(areExchanged({}, {}, kByStereo)) << "no lasers";
}

}  // namespace
}  // namespace urban_nav_input
