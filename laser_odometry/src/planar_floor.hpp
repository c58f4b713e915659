// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "laser_odometry/parameters.hpp"
#include "motion_space.hpp"

namespace laser_odometry {

/// Returns the parameters for a kind of motion: with planar motion, the rows of planar lasers replace those of 3D
/// LiDARs, and half as many patches are required, as half as many coordinates are estimated.
Parameters toScannerParameters(const Parameters& parameters, MotionSpace space);

/// Returns the covariance of height, roll and pitch of a pose that is assumed on the plane of the first one: unevenness
/// below the wheels. The other entries are zero.
urban_nav_core::Matrix6d floorOfPose(const Parameters& parameters);

/// Returns the covariance that a step of a length (m) adds to it: change of the height of the floor.
urban_nav_core::Matrix6d floorOfStep(const Parameters& parameters, double length);

}  // namespace laser_odometry
