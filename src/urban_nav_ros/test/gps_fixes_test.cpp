// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/gps_fixes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace urban_nav_ros {
namespace {

sensor_msgs::NavSatFix makeFix(int second) {
  sensor_msgs::NavSatFix message;
  message.header.stamp = ros::Time(second, 0);
  message.header.frame_id = "gps_link";
  message.latitude = 51.75;
  message.longitude = -1.25;
  message.altitude = 112.0;
  message.position_covariance[0] = 4.0;
  message.position_covariance[4] = 9.0;
  message.position_covariance[8] = 25.0;
  message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  return message;
}

tf2_msgs::TFMessage makeAntenna() {
  tf2_msgs::TFMessage message;
  const urban_nav_core::Pose T_base_gps(Eigen::Matrix3d(Eigen::Matrix3d::Identity()), Eigen::Vector3d(-0.2, 0.1, 1.4));
  message.transforms.push_back(toStaticTransform("base_link", "gps_link", T_base_gps));
  return message;
}

TEST(GpsFixes, WaitForThePlaceOfTheAntenna) {
  GpsFixes fixes("base_link");
  EXPECT_TRUE(fixes.add(makeFix(1)).empty());
  EXPECT_TRUE(fixes.add(makeFix(2)).empty());
  const auto made = fixes.add(makeAntenna());
  ASSERT_EQ(made.size(), 2U);
  EXPECT_EQ(made[1].reading.stamp, 2'000'000'000);
  EXPECT_EQ(made[0].reading.sigma, urban_nav_core::Vector3d(2.0, 3.0, 5.0));
  EXPECT_EQ(made[0].p_base, urban_nav_core::Vector3d(-0.2, 0.1, 1.4));
  EXPECT_EQ(fixes.add(makeFix(3)).size(), 1U);
}

TEST(GpsFixes, TakeTheOriginWithoutAPose) {
  GpsFixes fixes("base_link");
  for (int second = 1; second < 60; ++second) EXPECT_TRUE(fixes.add(makeFix(second)).empty());
  const auto made = fixes.add(makeFix(60));
  ASSERT_EQ(made.size(), 60U);
  EXPECT_EQ(made[0].p_base, urban_nav_core::Vector3d(0.0, 0.0, 0.0));
  EXPECT_TRUE(fixes.isAssumed());
  fixes.add(makeAntenna());
  EXPECT_FALSE(fixes.isAssumed()) << "late fixes are used";
  EXPECT_EQ(fixes.add(makeFix(61)).at(0).p_base, urban_nav_core::Vector3d(-0.2, 0.1, 1.4));
}

TEST(GpsFixes, IgnoreMessagesWithoutAFix) {
  GpsFixes fixes("base_link");
  fixes.add(makeAntenna());
  auto none = makeFix(1), odd = makeFix(2), high = makeFix(3), zero = makeFix(3);
  zero.latitude = zero.longitude = 0.0;
  none.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  odd.longitude = std::numeric_limits<double>::quiet_NaN();
  high.latitude = 91.0;
  for (const auto& each : {none, odd, high, zero}) EXPECT_TRUE(fixes.add(each).empty());
  EXPECT_EQ(fixes.add(makeFix(4)).size(), 1U);
}

TEST(GpsFixes, WithoutAnAltitudeStateTheHorizontalPosition) {
  GpsFixes fixes("base_link");
  fixes.add(makeAntenna());
  auto flat = makeFix(1);
  flat.altitude = std::numeric_limits<double>::quiet_NaN();
  const auto converted = fixes.add(flat);
  ASSERT_EQ(converted.size(), 1U);
  EXPECT_EQ(converted[0].reading.height, 0.0);
  EXPECT_EQ(converted[0].reading.sigma, urban_nav_core::Vector3d(2.0, 3.0, 1e4));
}

}  // namespace
}  // namespace urban_nav_ros
