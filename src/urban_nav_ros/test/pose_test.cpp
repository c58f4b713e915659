// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/pose.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/status.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::Health;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

TEST(Stamp, IsExactInBothDirections) {
  for (const urban_nav_core::StampNs stamp : {0LL, 1LL, 1225719873501685001LL, 4294967295999999999LL})
    EXPECT_EQ(toStampNs(toRosTime(stamp)), stamp);
  EXPECT_EQ(toStampNs(toRosTime(-5)), 0);
  EXPECT_EQ(toStampNs(toRosTime(std::numeric_limits<urban_nav_core::StampNs>::max())), 4294967295999999999LL);
}

TEST(PoseMessage, ComesBackTheSame) {
  const Pose pose(urban_nav_core::expSo3(Vector3d(0.3, -2.0, 1.0)), Vector3d(1, 2, 3));
  EXPECT_TRUE(isApprox(*toPose(toPoseMessage(pose)), pose, 1e-15));
  EXPECT_TRUE(isApprox(*toPose(toTransformMessage(pose)), pose, 1e-15));
}

TEST(PoseMessage, RefusesWhatIsNoPose) {
  geometry_msgs::Pose message;
  EXPECT_FALSE(toPose(message)) << "a quaternion of zeros";
  message.orientation.w = 0.9;
  EXPECT_FALSE(toPose(message));
  message.orientation.w = 1.0;
  EXPECT_TRUE(toPose(message));
  message.position.y = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(toPose(message));
}

TEST(RelativePoseMessage, ComesBackTheSame) {
  urban_nav_core::RelativePose relative;
  relative.from = 1'000'000'001;
  relative.to = 2'000'000'002;
  relative.T_from_to = Pose(urban_nav_core::expSo3(Vector3d(0.0, 0.1, 0.0)), Vector3d(1, 0, 0));
  relative.covariance = 0.01 * urban_nav_core::Matrix6d::Identity();
  relative.covariance(0, 5) = relative.covariance(5, 0) = 0.002;
  relative.status.health = Health::Degraded;
  relative.source = "swf_vo";
  const auto back = toRelativePose(toRelativePoseMessage(relative, "base_link"));
  ASSERT_TRUE(back);
  EXPECT_TRUE(isApprox(*back, relative, 1e-15));
  EXPECT_EQ(toRelativePoseMessage(relative, "base_link").covariance[5], 0.002);
  EXPECT_EQ(back->status.health, Health::Degraded);
  EXPECT_EQ(back->source, "swf_vo");
}

TEST(RelativePoseMessage, CarriesTheSessionUnlessItsIdIsNone) {
  urban_nav_core::RelativePose relative;
  relative.to = 1;
  urban_nav_msgs::RelativePose message = toRelativePoseMessage(relative, "base_link");
  EXPECT_EQ(toSessionStep(message)->session, nullptr);
  message.session = toOdometrySessionMessage({"0123456789abcdef0123", "monday (2)", "lisa", "monday", 1'000'000'001});
  const auto back = toSessionStep(message);
  ASSERT_TRUE(back && back->session);
  EXPECT_EQ(back->to, 1);
  EXPECT_EQ(back->session->id, "0123456789abcdef0123");
  EXPECT_EQ(back->session->name, "monday (2)");
  EXPECT_EQ(back->session->robot, "lisa");
  EXPECT_EQ(back->session->recording, "monday");
  EXPECT_EQ(back->session->start, 1'000'000'001);
  message.session.id = "../../../etc/passwd0";
  EXPECT_EQ(toSessionStep(message)->session, nullptr) << "ids become parts of paths";
}

TEST(RelativePoseMessage, CarriesConstantsOfTheRig) {
  urban_nav_core::RelativePose relative;
  relative.to = 1;
  const urban_nav_core::Vector6d sensitivity = (urban_nav_core::Vector6d() << 1, 2, 3, 4, 5, 6).finished();
  relative.constants = {{"disparity", 0.1, 0.2, 0.3, sensitivity}, {"scale", 0.0, 0.0, 5e-4, 2.0 * sensitivity}};
  urban_nav_msgs::RelativePose message = toRelativePoseMessage(relative, "base_link");
  EXPECT_EQ(message.sensitivity.size(), 12U);
  const auto back = toRelativePose(message);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->constants.size(), 2U);
  EXPECT_TRUE(isApprox(*back, relative, 0.0));
  relative.constants[1].sensitivity[5] = 13.0;
  EXPECT_FALSE(isApprox(*back, relative, 0.0));
  message.sensitivity.pop_back();
  EXPECT_FALSE(toRelativePose(message));
  message.sensitivity.push_back(std::nan(""));
  EXPECT_FALSE(toRelativePose(message));
}

TEST(HealthMessage, ConvertsFourStates) {
  for (const Health health : {Health::Ok, Health::Degraded, Health::Lost, Health::Recovered})
    EXPECT_EQ(toHealth(toMessage(health)), health);
  EXPECT_FALSE(toHealth(4));
  const auto message = toStatusMessage(5, "swf_vo", {Health::Lost, 3, "too dark"}, "Dark");
  EXPECT_EQ(message.status, urban_nav_msgs::StageStatus::LOST);
  EXPECT_EQ(message.message, "too dark");
}

}  // namespace
}  // namespace urban_nav_ros
