// SPDX-License-Identifier: BSD-3-Clause
#include "rig/sensor_poses.hpp"

#include <gtest/gtest.h>

namespace urban_nav_sim {
namespace {

using urban_nav_core::Vector3d;

/// Returns the direction of a sensor's axis in base_link.
Vector3d axis(const std::string& frame, const Vector3d& a) { return sensorPose(frame).q() * a; }

TEST(Places, CamerasFaceForwardAndAroundTheHorizon) {
  EXPECT_LT((axis("stereo_left_optical_frame", Vector3d::UnitZ()) - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((axis("stereo_left_optical_frame", Vector3d::UnitY()) + Vector3d::UnitZ()).norm(), 1e-12);
  const Vector3d between = sensorPose("stereo_right_optical_frame").t() - sensorPose("stereo_left_optical_frame").t();
  EXPECT_LT((between - Vector3d(0.0, -0.120005, 0.0)).norm(), 1e-9);
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < 5; ++i) {
    const std::string frame = "ladybug_camera" + std::to_string(i) + "_optical_frame";
    EXPECT_LT((axis(frame, Vector3d::UnitY()) + Vector3d::UnitZ()).norm(), 1e-12);
    sum += axis(frame, Vector3d::UnitZ());
  }
  EXPECT_LT(sum.norm(), 1e-9);
  EXPECT_LT(axis("ladybug_camera1_optical_frame", Vector3d::UnitZ()).y(), 0.0) << "clockwise seen from above";
}

TEST(Places, LasersScanAcrossThePath) {
  // Beam 90 deg (x of the laser) looks to the side; y, towards which angles grow, is up on the left and down on the
  // right.
  EXPECT_LT((axis("laser_left", Vector3d::UnitX()) - Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((axis("laser_left", Vector3d::UnitY()) - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((axis("laser_right", Vector3d::UnitX()) + Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((axis("laser_right", Vector3d::UnitY()) + Vector3d::UnitZ()).norm(), 1e-12);
}

}  // namespace
}  // namespace urban_nav_sim
