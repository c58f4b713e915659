// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/marker_builder.hpp"

#include <gtest/gtest.h>

namespace urban_nav_ros {
namespace {

using visualization_msgs::Marker;

TEST(MarkerBuilder, ReplaceEarlierMarkersAndLeaveOutWhatIsEmpty) {
  MarkerBuilder markers("map", 7);
  markers.addLines("none", {}, 0.1, toColour(1, 0, 0));
  markers.addStrip("point", 0, {{1, 2, 3}}, 0.1, toColour(1, 0, 0));
  markers.addLines("lines", {{0, 0, 0}, {1, 2, 3}}, 0.1, toColour(1, 0, 0, 0.5));
  markers.addStrip("strip", 4, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0.2, toColour(0, 1, 0));
  const auto& all = markers.message().markers;
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].action, Marker::DELETEALL);
  EXPECT_EQ(all[1].type, Marker::LINE_LIST);
  EXPECT_EQ(all[1].ns, "lines");
  EXPECT_EQ(all[1].points[1].z, 3.0);
  EXPECT_EQ(all[1].scale.x, 0.1);
  EXPECT_EQ(all[1].color.a, 0.5F);
  EXPECT_EQ(all[2].type, Marker::LINE_STRIP);
  EXPECT_EQ(all[2].id, 4);
  EXPECT_EQ(all[2].points.size(), 3U);
  for (const Marker& marker : all) EXPECT_EQ(marker.header.frame_id, "map");
}

TEST(MarkerBuilder, DrawsSpheresAndTexts) {
  MarkerBuilder markers("odom", 7);
  markers.addSpheres("none", {}, 0.4, toColour(1, 0, 0));
  markers.addSpheres("places", {{0, 0, 0}, {1, 2, 3}}, 0.4, toColour(1, 0, 0));
  markers.addText("belief", "KNOWN", {1, 2, 3}, 0.6, toColour(1, 1, 1));
  const auto& all = markers.message().markers;
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].type, Marker::SPHERE_LIST);
  EXPECT_EQ(all[1].points.size(), 2U);
  EXPECT_EQ(all[1].scale.x, 0.4);
  EXPECT_EQ(all[1].scale.z, 0.4);
  EXPECT_EQ(all[2].type, Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(all[2].text, "KNOWN");
  EXPECT_EQ(all[2].pose.position.y, 2.0);
  EXPECT_EQ(all[2].scale.z, 0.6);
}

}  // namespace
}  // namespace urban_nav_ros
