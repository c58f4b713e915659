// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/new_college_rig.hpp"

#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

urban_nav_core::StereoCamera newCollegeCamera() {
  constexpr double kFocalLength = 389.956085;  // px
  return {{kFocalLength, kFocalLength, 254.903519, 201.899490, 512, 384}, 0.120005};
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

}  // namespace urban_nav_input
