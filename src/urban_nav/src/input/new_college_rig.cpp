// SPDX-License-Identifier: BSD-3-Clause
#include "input/new_college_rig.hpp"

#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav {

using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

urban_nav_core::StereoCamera newCollegeCamera() {
  urban_nav_core::StereoCamera camera;
  camera.left.fx = camera.left.fy = 389.956085;
  camera.left.cx = 254.903519;
  camera.left.cy = 201.899490;
  camera.left.width = 512;
  camera.left.height = 384;
  camera.baseline = 0.120005;
  return camera;
}

Pose newCollegeLeftLaser() {
  Matrix3d R;
  R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return Pose(R, Vector3d(-0.030, 0.270, 0.75));
}

Pose newCollegeRightLaser() {
  Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Pose(R, Vector3d(-0.030, -0.270, 0.75));
}

Pose newCollegeLeftCamera() { return Pose(urban_nav_ros::opticalInBody().q(), Vector3d(0.1, 0.0, 1.1)); }

}  // namespace urban_nav
