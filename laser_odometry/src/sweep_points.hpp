// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/sweep.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

/// Returns of a sweep, each in base_link at the time of its measurement.
struct SweepPoints {
  std::vector<Eigen::Vector3f> p;      ///< m
  std::vector<float> time;             ///< s after the reference time; zeros without times
  double first_s = 0.0, last_s = 0.0;  ///< range of `time`
  int valid = 0;                       ///< finite beams, `near` and far ones included
  int near = 0;                        ///< dropped: nearer than min_range

  void archive(urban_nav_core::Archive& archive);
};

/// Returns the beams of a sweep between two ranges (m). Drops beams that are not finite, and those with a time more
/// than `longest_s` from the reference, which is invalid.
SweepPoints collectPoints(const urban_nav_core::Sweep& sweep, const Pose& T_base_lidar, double min_range,
                          double max_range, double longest_s);

/// Motion of base_link within a sweep, SE(3) tangents in base_link at the reference time: T_reference_now =
/// Exp(t twist + t^2 / 2 acceleration).
struct SweepMotion {
  Vector6d twist = Vector6d::Zero();         ///< m/s, rad/s
  Vector6d acceleration = Vector6d::Zero();  ///< m/s^2, rad/s^2

  SweepMotion operator+(const SweepMotion& other) const {
    return {twist + other.twist, acceleration + other.acceleration};
  }
  SweepMotion operator-(const SweepMotion& other) const {
    return {twist - other.twist, acceleration - other.acceleration};
  }
};

/// Transforms the points to base_link at the reference time. Error below 1 um for rotations of 0.3 rad in a sweep.
std::vector<Vector3d> deskew(const SweepPoints& points, const SweepMotion& motion);

}  // namespace laser_odometry
