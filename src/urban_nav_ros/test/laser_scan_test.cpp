// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/laser_scan.hpp"

#include <gtest/gtest.h>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

TEST(LaserScan, SaysAllThatATurnSays) {
  urban_nav_core::PlanarScan scan;
  scan.stamp = 1'225'719'873'123'456'789;
  scan.angle_first = -1.5;
  scan.angle_step = 0.5;
  scan.time_step = 1e-4;
  scan.period = 0.0133;
  scan.range_min = 0.1;
  scan.range_max = 81.0;
  scan.ranges = {1.0F, 2.0F, 3.0F, 4.0F};
  scan.intensities = {10.0F, 20.0F, 30.0F, 40.0F};
  const sensor_msgs::LaserScan message = toLaserScanMessage(scan, "laser_left");
  EXPECT_EQ(toStampNs(message.header.stamp), scan.stamp);
  EXPECT_EQ(message.header.frame_id, "laser_left");
  EXPECT_FLOAT_EQ(message.angle_min, -1.5F);
  EXPECT_FLOAT_EQ(message.angle_max, 0.0F) << "of the last beam, not one behind it";
  EXPECT_FLOAT_EQ(message.angle_increment, 0.5F);
  EXPECT_FLOAT_EQ(message.time_increment, 1e-4F);
  EXPECT_FLOAT_EQ(message.scan_time, 0.0133F);
  EXPECT_FLOAT_EQ(message.range_min, 0.1F);
  EXPECT_FLOAT_EQ(message.range_max, 81.0F);
  EXPECT_EQ(message.ranges, scan.ranges);
  EXPECT_EQ(message.intensities, scan.intensities);
}

}  // namespace
}  // namespace urban_nav_ros
