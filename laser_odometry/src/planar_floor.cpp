// SPDX-License-Identifier: BSD-3-Clause
#include "planar_floor.hpp"

#include <algorithm>
#include <cmath>

namespace laser_odometry {
namespace {

constexpr int kFewestPatches = 6;     // as the least value of the parameters
constexpr double kPoseHeight = 1e-3;  // m: floors of buildings are even to 1 mm below a wheel (DIN 18202)
constexpr double kLeastStep = 1e-6;   // m and rad: keeps the covariance of a step positive definite

}  // namespace

Parameters toScannerParameters(const Parameters& parameters, MotionSpace space) {
  Parameters p = parameters;
  if (space == MotionSpace::Spatial) return p;
  p.cell = parameters.planar_cell;
  p.min_range = parameters.planar_min_range;
  p.lost_patches = std::max(kFewestPatches, parameters.lost_patches / 2);
  p.degraded_patches = std::max(kFewestPatches, parameters.degraded_patches / 2);
  return p;
}

urban_nav_core::Matrix6d floorOfPose(const Parameters& parameters) {
  const double tilt = parameters.floor_tilt * M_PI / 180.0;
  urban_nav_core::Vector6d variances;
  variances << 0.0, 0.0, kPoseHeight * kPoseHeight, tilt * tilt, tilt * tilt, 0.0;
  return variances.asDiagonal();
}

urban_nav_core::Matrix6d floorOfStep(const Parameters& parameters, double length) {
  const double height = parameters.floor_height * parameters.floor_height * length;
  const double least = kLeastStep * kLeastStep;
  urban_nav_core::Vector6d variances;
  variances << 0.0, 0.0, height + least, least, least, 0.0;
  return variances.asDiagonal();
}

}  // namespace laser_odometry
