// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

Pose pose(double x, double yaw) { return Pose(urban_nav_core::expSo3(Vector3d(0.0, 0.0, yaw)), Vector3d(x, 1, 2)); }

urban_nav_core::GraphUpdate update() {
  urban_nav_core::GraphUpdate update;
  update.revision = 7;
  update.previous = 5;
  update.segments = {{"a", {{10, pose(1.0, 0.1)}, {20, pose(2.0, 0.2)}}}, {"b", {{5, pose(3.0, -3.0)}}}};
  return update;
}

TEST(GraphUpdateMessage, ComesBackTheSame) {
  const auto message = toGraphUpdateMessage(update(), 4'000'000'000, "map");
  EXPECT_EQ(message.header.stamp, toRosTime(4'000'000'000));
  EXPECT_EQ(message.header.frame_id, "map");
  const auto back = toGraphUpdate(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->revision, 7);
  EXPECT_EQ(back->previous, 5);
  ASSERT_EQ(back->segments.size(), 2U);
  EXPECT_EQ(back->segments[1].session, "b");
  ASSERT_EQ(back->segments[0].poses.size(), 2U);
  EXPECT_EQ(back->segments[0].poses[1].stamp, 20);
  EXPECT_TRUE(isApprox(back->segments[0].poses[1].T_map_base, pose(2.0, 0.2), 1e-15));
}

TEST(GraphUpdateMessage, RefusesRunsThatAreNone) {
  const auto good = toGraphUpdateMessage(update(), 20, "map");
  auto bad = good;
  bad.segments[0].stamps.pop_back();
  EXPECT_FALSE(toGraphUpdate(bad)) << "two poses at one time";
  bad = good;
  std::swap(bad.segments[0].stamps[0], bad.segments[0].stamps[1]);
  EXPECT_FALSE(toGraphUpdate(bad)) << "backwards";
  bad = good;
  bad.segments[1].T_map_base[0].orientation.w = 3.0;
  EXPECT_FALSE(toGraphUpdate(bad));
  bad = good;
  bad.segments.clear();
  EXPECT_TRUE(toGraphUpdate(bad)) << "no pose changed";
}

TEST(PoseCorrectionMessage, ComesBackTheSameWithItsSize) {
  urban_nav_core::PoseCorrection correction;
  correction.revision = 8;
  correction.at = {"a", 3'000'000'000};
  correction.T_map_base_before = pose(1.0, 0.0);
  correction.T_map_base_after = pose(4.0, 0.5);
  correction.reason = 2;
  correction.reason_name = "ClosuresAccepted";
  correction.sentence = "two closures agree";
  correction.causing_edges = {{{"a", 1}, {"a", 3}, "stereo", "loop_metric"},
                              {{"a", 2}, {"a", 4}, "icp", "loop_metric"}};
  const auto message = toPoseCorrectionMessage(correction, "map");
  EXPECT_EQ(message.header.stamp, toRosTime(3'000'000'000));
  EXPECT_NEAR(message.distance, 3.0, 1e-12);
  EXPECT_NEAR(message.angle, 0.5, 1e-12);
  const auto back = toPoseCorrection(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->revision, 8);
  EXPECT_EQ(back->at, correction.at);
  EXPECT_TRUE(isApprox(back->T_map_base_before, correction.T_map_base_before, 1e-15));
  EXPECT_TRUE(isApprox(back->T_map_base_after, correction.T_map_base_after, 1e-15));
  EXPECT_EQ(back->reason, 2);
  EXPECT_EQ(back->reason_name, "ClosuresAccepted");
  EXPECT_EQ(back->sentence, "two closures agree");
  ASSERT_EQ(back->causing_edges.size(), 2U);
  EXPECT_EQ(back->causing_edges[1], correction.causing_edges[1]);
  auto bad = message;
  bad.T_map_base_after.position.z = std::nan("");
  EXPECT_FALSE(toPoseCorrection(bad));
}

}  // namespace
}  // namespace urban_nav_ros
