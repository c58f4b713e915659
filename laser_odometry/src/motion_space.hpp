// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/se3.hpp"

namespace laser_odometry {

/// Coordinates of a motion that are estimated; the others are assumed (docs/derivations/laser_odometry.md, planar
/// lasers).
enum class MotionSpace {
  Spatial,  ///< all six
  Planar    ///< x, y and yaw: translations in the x-y plane of odom, and rotations about its z axis
};

/// Returns the pose with the x, y and yaw of another, all other coordinates zero.
urban_nav_core::Pose toPlanar(const urban_nav_core::Pose& T);

/// Returns a covariance without the rows and columns of height, roll and pitch.
urban_nav_core::Matrix6d toPlanar(const urban_nav_core::Matrix6d& covariance);

}  // namespace laser_odometry
