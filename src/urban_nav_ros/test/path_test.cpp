// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/path.hpp"

#include <gtest/gtest.h>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::TrajectorySegment;

TrajectorySegment straight(int poses, double step) {
  TrajectorySegment run;
  run.session = "s";
  for (int i = 0; i < poses; ++i) run.poses.push_back({i, Pose(Quaterniond::Identity(), {step * i, 0, 0})});
  return run;
}

TEST(Path, ThinsToTheSpacingAndKeepsTheEnds) {
  const TrajectorySegment thin = thinned(straight(101, 0.1), 1.0);
  EXPECT_EQ(thin.session, "s");
  EXPECT_NEAR(static_cast<double>(thin.poses.size()), 11.0, 1.0);
  EXPECT_EQ(thin.poses.front().stamp, 0);
  EXPECT_EQ(thin.poses.back().stamp, 100);
  for (std::size_t i = 1; i + 1 < thin.poses.size(); ++i)
    EXPECT_GE(distanceBetween(thin.poses[i - 1].T_map_base, thin.poses[i].T_map_base), 1.0);
  EXPECT_EQ(thinned(straight(1, 0.1), 1.0).poses.size(), 1U);
  EXPECT_TRUE(thinned(TrajectorySegment(), 1.0).poses.empty());
}

TEST(Path, ThePathHasTheStampsOfItsPoses) {
  const nav_msgs::Path path = toPathMessage(straight(3, 2.0), "map");
  ASSERT_EQ(path.poses.size(), 3U);
  EXPECT_EQ(path.header.frame_id, "map");
  EXPECT_EQ(path.header.stamp, toRosTime(2));
  EXPECT_EQ(path.poses[1].header.stamp, toRosTime(1));
  EXPECT_EQ(path.poses[1].pose.position.x, 2.0);
}

}  // namespace
}  // namespace urban_nav_ros
