// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/laser_scan.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

TEST(LaserScan, ConvertsAllValuesOfATurn) {
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
  EXPECT_FLOAT_EQ(message.angle_max, 0.0F) << "of the last beam, not one after it";
  EXPECT_FLOAT_EQ(message.angle_increment, 0.5F);
  EXPECT_FLOAT_EQ(message.time_increment, 1e-4F);
  EXPECT_FLOAT_EQ(message.scan_time, 0.0133F);
  EXPECT_FLOAT_EQ(message.range_min, 0.1F);
  EXPECT_FLOAT_EQ(message.range_max, 81.0F);
  EXPECT_EQ(message.ranges, scan.ranges);
  EXPECT_EQ(message.intensities, scan.intensities);
  const auto back = toPlanarScan(message);
  ASSERT_TRUE(back);
  EXPECT_TRUE(isApprox(*back, scan, 1e-6));
}

TEST(LaserScan, WhoseBeamsCannotBePlacedIsNone) {
  sensor_msgs::LaserScan good;
  good.header.stamp = ros::Time(5.0);
  good.angle_increment = 0.01F;
  good.range_max = 80.0F;
  good.ranges = {1.0F, std::numeric_limits<float>::quiet_NaN(), 3.0F};
  good.intensities = {1.0F};
  ASSERT_TRUE(toPlanarScan(good));
  EXPECT_TRUE(toPlanarScan(good)->intensities.empty()) << "not as many as the ranges";
  EXPECT_EQ(urban_nav_core::toScan(*toPlanarScan(good)).beams.size(), 2U);
  const float infinite = std::numeric_limits<float>::infinity();
  sensor_msgs::LaserScan bad = good;
  bad.angle_min = bad.angle_max = infinite;
  EXPECT_FALSE(toPlanarScan(bad));
  bad = good;
  bad.angle_increment = infinite;  // and both ends are 0
  EXPECT_FALSE(toPlanarScan(bad));
  good.time_increment = infinite;
  ASSERT_TRUE(toPlanarScan(good));
  EXPECT_EQ(toPlanarScan(good)->time_step, 0.0);
  good.header.stamp = ros::Time();
  EXPECT_FALSE(toPlanarScan(good));
}

TEST(LaserScan, LimitsThatAreNoneDropNoBeam) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(5.0);
  scan.angle_increment = 0.01F;
  scan.range_max = 80.0F;
  scan.ranges = {1.0F, 2.0F, 3.0F};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float limit : {0.0F, nan, std::numeric_limits<float>::infinity(), -1.0F}) {
    scan.range_max = limit;
    EXPECT_TRUE(hasNoRangeLimit(scan));
    ASSERT_TRUE(toPlanarScan(scan)) << limit;
    EXPECT_EQ(urban_nav_core::toScan(*toPlanarScan(scan)).beams.size(), 3U) << limit;
  }
  scan.range_min = nan;
  scan.scan_time = nan;
  ASSERT_TRUE(toPlanarScan(scan));
  EXPECT_EQ(toPlanarScan(scan)->period, 0.0);
  EXPECT_EQ(urban_nav_core::toScan(*toPlanarScan(scan)).beams.size(), 3U);
}

TEST(LaserScan, OtherUnitsAreRefusedUnlessTheyAreStated) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(5.0);
  scan.angle_min = -90.0F;
  scan.angle_increment = 1.0F;
  scan.range_max = 80'000.0F;
  scan.ranges.assign(181, 5000.0F);
  EXPECT_FALSE(toPlanarScan(scan));
  EXPECT_EQ(checkUnits(scan).fault, urban_nav_core::ScanFault::AngleUnit);
  urban_nav_core::LaserConvention stated;
  stated.angle_scale = checkUnits(scan).repair;
  EXPECT_EQ(checkUnits(scan, stated).fault, urban_nav_core::ScanFault::RangeUnit);
  stated.range_scale = checkUnits(scan, stated).repair;
  stated.delay = 500'000'000;
  const auto planar = toPlanarScan(scan, stated);
  ASSERT_TRUE(planar);
  EXPECT_EQ(planar->stamp, 4'500'000'000);
  EXPECT_NEAR(planar->angle_first, -1.5707963, 1e-6);
  const urban_nav_core::Scan beams = urban_nav_core::toScan(*planar);
  ASSERT_EQ(beams.beams.size(), 181U);
  EXPECT_NEAR(beams.beams.front().range, 5.0F, 1e-5F);
}

TEST(LaserScan, ScalesApplyToTheNumbersThatAreInTheirUnits) {
  sensor_msgs::LaserScan sound;
  sound.header.stamp = ros::Time(5.0);
  sound.angle_min = -1.5F;
  sound.angle_increment = 0.01F;
  sound.angle_max = 1.5F;
  sound.range_max = 30.0F;
  for (int i = 0; i < 301; ++i) sound.ranges.push_back(4.0F + 0.02F * static_cast<float>(i));
  const urban_nav_core::Scan expected = urban_nav_core::toScan(*toPlanarScan(sound));
  constexpr float kDegreesPerRadian = 57.29578F;
  sensor_msgs::LaserScan increment = sound, ends = sound, millimetres = sound;
  increment.angle_increment *= kDegreesPerRadian;
  ends.angle_min *= kDegreesPerRadian, ends.angle_max *= kDegreesPerRadian;
  for (float& range : millimetres.ranges) range *= 1000.0F;
  for (const sensor_msgs::LaserScan& scan : {increment, ends, millimetres}) {
    EXPECT_FALSE(toPlanarScan(scan));
    const urban_nav_core::ScanVerdict verdict = checkUnits(scan);
    urban_nav_core::LaserConvention stated;
    (verdict.fault == urban_nav_core::ScanFault::AngleUnit ? stated.angle_scale : stated.range_scale) = verdict.repair;
    ASSERT_TRUE(toPlanarScan(scan, stated));
    const urban_nav_core::Scan repaired = urban_nav_core::toScan(*toPlanarScan(scan, stated));
    ASSERT_EQ(repaired.beams.size(), expected.beams.size());
    for (const std::size_t i : {std::size_t{0}, std::size_t{300}}) {
      EXPECT_NEAR(repaired.beams[i].range, expected.beams[i].range, 1e-4F);
      EXPECT_NEAR((repaired.beams[i].direction - expected.beams[i].direction).norm(), 0.0F, 1e-4F);
    }
  }
}

TEST(LaserScan, ARangeOfNoReturnIsNoUnit) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(5.0);
  scan.angle_increment = 0.01F;
  scan.range_max = 30.0F;
  scan.ranges.assign(301, 655.35F);
  for (std::size_t i = 0; i < 20; ++i) scan.ranges[i] = 5.0F;
  EXPECT_EQ(checkUnits(scan).fault, urban_nav_core::ScanFault::None);
}

}  // namespace
}  // namespace urban_nav_ros
