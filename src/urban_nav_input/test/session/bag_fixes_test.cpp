// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/bag_fixes.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/NavSatFix.h>
#include <tf2_msgs/TFMessage.h>

#include <limits>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

sensor_msgs::NavSatFix navSatFix(double seconds, double latitude) {
  sensor_msgs::NavSatFix fix;
  fix.header.stamp = ros::Time(1'225'719'872.0 + seconds);
  fix.header.frame_id = "gps_link";
  fix.latitude = latitude;
  fix.longitude = -1.25;
  fix.altitude = 112.0;
  fix.position_covariance[0] = 4.0;
  fix.position_covariance[4] = 9.0;
  fix.position_covariance[8] = 25.0;
  fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  return fix;
}

std::string bagWithFixes(const testing::TemporaryFolder& folder, const std::string& topic) {
  const std::string path = folder.file("fixes.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const ros::Time start(1'225'719'872.0);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(urban_nav_ros::toStaticTransform(
      "base_link", "gps_link", Pose(Eigen::Quaterniond::Identity(), Vector3d(-0.1, 0.0, 1.4))));
  bag.write("/tf_static", start, transforms);
  bag.write(topic, start, navSatFix(0.0, 51.75));
  sensor_msgs::NavSatFix none = navSatFix(1.0, 51.76), broken = navSatFix(2.0, 51.76), vague = navSatFix(3.0, 51.77);
  none.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  broken.latitude = std::numeric_limits<double>::quiet_NaN();
  vague.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  for (const auto& fix : {none, broken, vague}) bag.write(topic, start, fix);
  return path;
}

TEST(BagFixes, AreReadWithTheirUncertaintyAndThePlaceOfTheAntenna) {
  const testing::TemporaryFolder folder;
  const BagFixes fixes = readBagFixes({bagWithFixes(folder, "/gps/fix")}, {});
  EXPECT_EQ(fixes.topic, "/gps/fix");
  ASSERT_EQ(fixes.readings.size(), 2U) << "neither the one without a fix nor the one with NaN";
  EXPECT_EQ(fixes.readings[0].stamp, 1'225'719'872'000'000'000);
  EXPECT_EQ(fixes.readings[0].latitude, 51.75);
  EXPECT_EQ(fixes.readings[0].height, 112.0);
  EXPECT_EQ(fixes.readings[0].sigma, Vector3d(2.0, 3.0, 5.0));
  EXPECT_EQ(fixes.readings[1].sigma, Vector3d(5.0, 5.0, 10.0)) << "of an unknown covariance";
  EXPECT_TRUE(fixes.is_placed);
  EXPECT_LT((fixes.p_base - Vector3d(-0.1, 0.0, 1.4)).norm(), 1e-12);
}

TEST(BagFixes, AreMeasuredEarlierByTheDelay) {
  const testing::TemporaryFolder folder;
  const BagFixes fixes = readBagFixes({bagWithFixes(folder, "/gps/fix")}, {}, {}, 18'000'000'000);
  ASSERT_EQ(fixes.readings.size(), 2U);
  EXPECT_EQ(fixes.readings[0].stamp, 1'225'719'854'000'000'000);
}

TEST(BagFixes, FollowTheUsersTopicAndAreEmptyWithoutOne) {
  const testing::TemporaryFolder folder;
  const std::string bag = bagWithFixes(folder, "/novatel/position");
  EXPECT_TRUE(readBagFixes({bag}, {}).topic.empty());
  EXPECT_EQ(readBagFixes({bag}, {"gps:=/novatel/position"}).readings.size(), 2U);
  EXPECT_THROW(readBagFixes({bag}, {"gps:=/tf_static"}), urban_nav_core::UserError);
  EXPECT_TRUE(readBagFixes({}, {}).readings.empty());
}

}  // namespace
}  // namespace urban_nav_input
