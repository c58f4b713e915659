// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "moments.hpp"
#include "motion_space.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/sweep.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

/// Consecutive returns of one ring that are close together. Assigned to a cube as a unit, by their mean: the noise of
/// single ranges would divide a surface near the border of two cubes by the sign of the noise, which displaces the
/// parts (docs/derivations/laser_odometry.md).
struct Segment {
  Vector3d mean = Vector3d::Zero();        ///< m
  Matrix3d covariance = Matrix3d::Zero();  ///< of the returns, m^2
  double count = 0.0;                      ///< returns
  double time = 0.0;                       ///< mean time, s after the reference time of the sweep; 0 without times
  double half_square = 0.0;                ///< mean of half of the squared time, s^2
  std::int32_t ring = 0;                   ///< Beam::ring, or kUnknownRing

  static constexpr std::int32_t kUnknownRing = -3;

  void archive(urban_nav_core::Archive& archive) { archive(mean, covariance, count, time, half_square, ring); }
};

/// Returns of a sweep, each in base_link at the time of its measurement.
struct SweepPoints {
  std::vector<Segment> segments;       ///< in order of their first returns
  double first_s = 0.0, last_s = 0.0;  ///< range of the times of the returns
  int used = 0;                        ///< returns in `segments`
  int valid = 0;                       ///< finite beams, `near` and far ones included
  int near = 0;                        ///< dropped: nearer than min_range

  void archive(urban_nav_core::Archive& archive);
};

/// Which beams are used, and how they are divided.
struct PointsRule {
  double min_range = 0.5, max_range = 100.0;  ///< m
  double longest_s = 1.0;                     ///< s, of a valid time from the reference
  double length = 0.25;                       ///< m, largest distance between returns of a segment
  /// Planar: points are projected to the x-y plane of base_link, since walls are vertical.
  MotionSpace space = MotionSpace::Spatial;
};

/// Returns the beams of a sweep between two ranges. Drops beams that are not finite, and those with an invalid time.
/// Without rings (all beams of a 3D LiDAR have the same), each return is a segment.
SweepPoints collectPoints(const urban_nav_core::Sweep& sweep, const Pose& T_base_lidar, const PointsRule& rule);

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

/// Transforms the segments to base_link at the reference time. Error below 1 um for rotations of 0.3 rad in a sweep.
std::vector<Segment> deskew(const SweepPoints& points, const SweepMotion& motion);

/// Transforms segments to another frame.
std::vector<Segment> transformed(const Pose& T, std::vector<Segment> segments);

}  // namespace laser_odometry
