// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

#include "loop_metric/evidence.hpp"
#include "robot.hpp"
#include "urban_nav_ros/testing/scanning_robot.hpp"

namespace loop_metric::test {
namespace {

using Scanning = ScanningRobot<Robot>;
using urban_nav_core::Vector6d;
using urban_nav_msgs::MetricClosure;

Eigen::Matrix<double, 6, 6, Eigen::RowMajor> toInformation(const MetricClosure& closure) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(closure.information.data());
}

TEST(LoopMetricNodeletScans, WhereNoViewsAreCloudsOfOppositeDirectionsAreAligned) {
  Scanning robot;
  ASSERT_TRUE(robot.scanning());
  ASSERT_TRUE(robot.call("reset"));
  robot.forget();
  const long before = std::atol(robot.diagnosis("scans").c_str());
  robot.drive(0, kFrames);
  ASSERT_TRUE(Robot::until([&] { return robot.diagnosis("parts of its odometry") == "1"; }));
  robot.scan(0, kFrames);
  ASSERT_TRUE(Robot::until([&] { return std::atol(robot.diagnosis("scans").c_str()) >= before + 2 * kFrames; }))
      << robot.diagnosis("scans");

  const auto recognise = [&](int a, int b) { robot.recognise({"", Scanning::toStamp(a)}, {"", Scanning::toStamp(b)}); };
  const int a = Scanning::there(0.0), b = Scanning::back(0.0);
  recognise(a, b);
  ASSERT_TRUE(robot.judged(1));
  const MetricClosure first = robot.closures[0];
  ASSERT_EQ(first.verdict, MetricClosure::ACCEPTED) << first.reason_name << ": " << first.message << "\n"
                                                    << first.evidence;
  EXPECT_EQ(first.method, MetricClosure::ICP);
  EXPECT_TRUE(first.odometry_gate);
  EXPECT_EQ(first.a.stamp, urban_nav_ros::toRosTime(Scanning::toStamp(a)));
  const Pose truth = Scanning::T_world_base(a).inverse() * Scanning::T_world_base(b);
  const Pose T_a_b = *urban_nav_ros::toPose(first.T_a_b);
  const Evidence evidence = parseEvidence(first.evidence);
  ASSERT_EQ(evidence.tries.back().method, urban_nav_core::ClosureMethod::Icp);
  EXPECT_GT(urban_nav_core::distanceBetween(*evidence.tries.back().guess, truth), 0.3) << "odometry is less accurate";
  EXPECT_LT(urban_nav_core::distanceBetween(T_a_b, truth), 0.03);
  EXPECT_LT(urban_nav_core::angleBetween(T_a_b, truth), 0.005);
  const Vector6d off = urban_nav_core::boxMinus(T_a_b, truth);
  EXPECT_LT(off.dot(toInformation(first) * off), 22.5) << "chi2 of 6, one in a thousand";
  EXPECT_GT(toInformation(first).diagonal().minCoeff(), 1.0 / (0.1 * 0.1)) << "with information";

  // The picture shows both clouds: red for the first, blue for the second.
  ASSERT_TRUE(Robot::until([&] { return !robot.pictures.empty(); }));
  const sensor_msgs::Image picture = robot.pictures.front();
  EXPECT_EQ(picture.encoding, "bgr8");
  EXPECT_EQ(picture.header.stamp, first.b.stamp);
  std::size_t red = 0, blue = 0;
  for (std::size_t i = 0; i + 2 < picture.data.size(); i += 3) {
    if (picture.data[i + 2] > picture.data[i] + 60) ++red;
    if (picture.data[i] > picture.data[i + 2] + 60) ++blue;
  }
  EXPECT_GT(red, 1000U);
  EXPECT_GT(blue, 1000U);

  // Half a metre further on, nearly the same beams are measured: their information is not counted again.
  recognise(a - 5, b + 5);
  ASSERT_TRUE(robot.judged(2));
  const MetricClosure& second = robot.closures[1];
  ASSERT_EQ(second.verdict, MetricClosure::ACCEPTED) << second.reason_name << ": " << second.message;
  EXPECT_EQ(second.method, MetricClosure::ICP);
  const double share = toInformation(second).trace() / toInformation(first).trace();
  EXPECT_GT(share, 0.01);
  EXPECT_LT(share, 0.2) << "0.1: two displacements of half a metre relative to 20 m";
}

}  // namespace
}  // namespace loop_metric::test
