// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/extrinsics.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace urban_nav_ros {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

Pose at(double x, double yaw) { return Pose(urban_nav_core::expSo3(Vector3d(0, 0, yaw)), Vector3d(x, 0.5, 0)); }

TEST(StaticTransforms, WalkUpAndDownTheTree) {
  StaticTransforms transforms;
  transforms.add(toStaticTransform("base_link", "mast", at(1.0, 0.3)));
  transforms.add(toStaticTransform("/mast", "/camera", at(2.0, -0.8)));
  transforms.add(toStaticTransform("base_link", "laser", at(-1.0, 2.0)));
  const Pose T_base_camera = at(1.0, 0.3) * at(2.0, -0.8);
  EXPECT_TRUE(isApprox(*transforms.lookup("base_link", "camera"), T_base_camera, 1e-12));
  EXPECT_TRUE(isApprox(*transforms.lookup("laser", "camera"), at(-1.0, 2.0).inverse() * T_base_camera, 1e-12));
  EXPECT_TRUE(isApprox(*transforms.lookup("camera", "camera"), Pose(), 1e-12));
  EXPECT_FALSE(transforms.lookup("base_link", "moon"));
  EXPECT_TRUE(transforms.has("mast"));
  EXPECT_EQ(transforms.frames().size(), 4U);
}

TEST(StaticTransforms, TakeTheLaterOfTwoAndNameWhatIsNone) {
  StaticTransforms transforms;
  transforms.add(toStaticTransform("base_link", "camera", at(1.0, 0.0)));
  transforms.add(toStaticTransform("base_link", "camera", at(2.0, 0.0)));
  EXPECT_NEAR(transforms.lookup("base_link", "camera")->t().x(), 2.0, 1e-12);
  geometry_msgs::TransformStamped broken = toStaticTransform("base_link", "imu", Pose());
  broken.transform.rotation.w = 0.0;
  transforms.add(broken);
  broken.transform.rotation.w = 1.0;
  broken.transform.translation.x = std::numeric_limits<double>::quiet_NaN();
  transforms.add(broken);
  transforms.add(toStaticTransform("gps", "gps", Pose()));
  EXPECT_EQ(transforms.faults().size(), 3U);
  EXPECT_FALSE(transforms.has("imu"));
}

TEST(StaticTransforms, NameTwoThatContradictEachOther) {
  StaticTransforms transforms;
  transforms.add(toStaticTransform("base_link", "laser_left", at(1.0, 0.3)));
  transforms.add(toStaticTransform("base_link", "laser_left", at(1.0, 0.3)));
  EXPECT_TRUE(transforms.faults().empty()) << "equal transforms are merged";
  transforms.add(toStaticTransform("base_link", "laser_left", at(1.3, 0.3)));
  transforms.add(toStaticTransform("base_link", "laser_left", at(1.3, 0.3)));
  ASSERT_EQ(transforms.faults().size(), 1U);
  EXPECT_NE(transforms.faults()[0].find("contradict"), std::string::npos);
  EXPECT_NE(transforms.faults()[0].find("0.3 m"), std::string::npos) << transforms.faults()[0];
  transforms.add(toStaticTransform("mast", "laser_left", at(1.3, 0.3)));
  ASSERT_EQ(transforms.faults().size(), 2U);
  EXPECT_NE(transforms.faults()[1].find("mast"), std::string::npos);
}

TEST(StaticTransforms, NormaliseQuaternionsAndNameThem) {
  StaticTransforms transforms;
  geometry_msgs::TransformStamped longer = toStaticTransform("base_link", "camera", at(1.0, 0.4));
  auto& q = longer.transform.rotation;
  q.x *= 1.02, q.y *= 1.02, q.z *= 1.02, q.w *= 1.02;
  transforms.add(longer);
  ASSERT_TRUE(transforms.lookup("base_link", "camera"));
  EXPECT_TRUE(isApprox(*transforms.lookup("base_link", "camera"), at(1.0, 0.4), 1e-12));
  ASSERT_EQ(transforms.faults().size(), 1U);
  EXPECT_NE(transforms.faults()[0].find("1.02"), std::string::npos);
}

TEST(StaticTransforms, WhatTheUserGivesTakesPrecedence) {
  StaticTransforms transforms;
  transforms.add(toStaticTransform("base_link", "camera", at(1.0, 0.0)));
  transforms.give(toStaticTransform("base_link", "camera", at(2.0, 0.0)));
  transforms.add(toStaticTransform("base_link", "camera", at(3.0, 0.0)));
  EXPECT_NEAR(transforms.lookup("base_link", "camera")->t().x(), 2.0, 1e-12);
  EXPECT_TRUE(transforms.faults().empty());
}

TEST(StaticTransforms, SurviveARing) {
  StaticTransforms transforms;
  transforms.add(toStaticTransform("a", "b", Pose()));
  transforms.add(toStaticTransform("b", "a", Pose()));
  EXPECT_FALSE(transforms.lookup("a", "b"));
}

TEST(StaticTransforms, NameTheLinkThatMovesBelowAFrame) {
  StaticTransforms transforms;
  transforms.add(toStaticTransform("tilt_link", "laser", Pose()));
  transforms.add(toStaticTransform("base_link", "camera", Pose()));
  transforms.addMoving("base_link", "/tilt_link");
  transforms.addMoving("odom", "base_link");
  EXPECT_EQ(transforms.findMoving("base_link", "laser"), "tilt_link");
  EXPECT_EQ(transforms.findMoving("base_link", "camera"), "");
  EXPECT_EQ(transforms.findMoving("base_footprint", "laser"), "");
  EXPECT_FALSE(transforms.lookup("base_link", "laser"));
  transforms.addMoving("laser", "odom");  // a cycle
  EXPECT_EQ(transforms.findMoving("base_footprint", "laser"), "");
}

TEST(OpticalInBody, TurnsForwardIntoDepth) {
  EXPECT_LT((opticalInBody() * Vector3d(0, 0, 1) - Vector3d(1, 0, 0)).norm(), 1e-12);   // ahead
  EXPECT_LT((opticalInBody() * Vector3d(1, 0, 0) - Vector3d(0, -1, 0)).norm(), 1e-12);  // right
  EXPECT_LT((opticalInBody() * Vector3d(0, 1, 0) - Vector3d(0, 0, -1)).norm(), 1e-12);  // down
}

}  // namespace
}  // namespace urban_nav_ros
