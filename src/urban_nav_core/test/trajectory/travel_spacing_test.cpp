// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/travel_spacing.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_core {
namespace {

constexpr StampNs kTenth = 100'000'000;  // ns

Pose poseAt(double x, double heading = 0.0) {
  return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())), {x, 0.0, 0.0});
}

TEST(TravelSpacing, SelectsByDistanceTurnAndTime) {
  TravelSpacing spacing({0.25, 0.1});
  EXPECT_FALSE(spacing.any());
  EXPECT_TRUE(spacing.takes(0, std::nullopt));
  EXPECT_TRUE(spacing.any());
  EXPECT_FALSE(spacing.takes(kTenth, std::nullopt));
  EXPECT_TRUE(spacing.takes(2 * kTenth, poseAt(0.0))) << "the first pose";
  EXPECT_FALSE(spacing.takes(3 * kTenth, poseAt(0.24)));
  EXPECT_TRUE(spacing.takes(4 * kTenth, poseAt(0.26)));
  EXPECT_FALSE(spacing.takes(5 * kTenth, poseAt(0.3, 0.09)));
  EXPECT_TRUE(spacing.takes(6 * kTenth, poseAt(0.3, 0.11)));
  EXPECT_FALSE(spacing.takes(105 * kTenth, poseAt(0.3, 0.11)));
  EXPECT_TRUE(spacing.takes(106 * kTenth, poseAt(0.3, 0.11))) << "ten seconds at rest";
}

TEST(TravelSpacing, ContinuesFromItsState) {
  TravelSpacing before({0.25, 0.1}), after({0.25, 0.1});
  before.takes(0, poseAt(1.0));
  Archive writing;
  before.archive(writing);
  const std::string bytes = writing.take();
  Archive reading(bytes, "spacing");
  after.archive(reading);
  reading.finish();
  EXPECT_FALSE(after.takes(kTenth, poseAt(1.2)));
  EXPECT_TRUE(after.takes(2 * kTenth, poseAt(1.3)));
}

}  // namespace
}  // namespace urban_nav_core
