// SPDX-License-Identifier: BSD-3-Clause
#include "markers.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
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

TEST(Markers, ClosuresAreDrawnByTheirVerdict) {
  const std::vector<ClosureMarker> closures = {{{0, 0, 0}, {1, 0, 0}, ClosureMarker::Style::Icp},
                                               {{0, 0, 0}, {2, 0, 0}, ClosureMarker::Style::Rejected},
                                               {{0, 0, 0}, {3, 0, 0}, ClosureMarker::Style::Icp}};
  const auto array = toMarkers(closures, {straight(5, 1.0), straight(1, 1.0)}, 7, "map");
  ASSERT_EQ(array.markers.size(), 4U) << "clearing, two styles, one line";
  EXPECT_EQ(array.markers[0].action, visualization_msgs::Marker::DELETEALL);
  EXPECT_EQ(array.markers[1].ns, "icp");
  EXPECT_EQ(array.markers[1].points.size(), 4U);
  EXPECT_EQ(array.markers[2].ns, "rejected");
  EXPECT_EQ(array.markers[3].ns, "trajectory");
  EXPECT_EQ(array.markers[3].points.size(), 5U);
  for (const auto& marker : array.markers) EXPECT_EQ(marker.header.frame_id, "map");
}

}  // namespace
}  // namespace pose_graph
