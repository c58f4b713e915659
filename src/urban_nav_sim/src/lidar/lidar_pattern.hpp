// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "urban_nav_sim/lidar_model.hpp"

namespace urban_nav_sim {

/// Directions and times of the beams of a LiDAR. A sweep takes 0.1 s and consists of columns; in each column every
/// laser fires once, from ring 0 (the lowest) upwards, at equal intervals, while the sensor keeps turning. Frame: x
/// forward, y left, z up.
///
/// Rings: 2000 columns, clockwise seen from above, beginning at the back (azimuth pi), as KITTI's HDL-64E. Elevations
/// are evenly spaced: -15 to 15 deg below 32 rings (VLP-16), -25 to 15 deg from 32 rings on (VLS-128).
///
/// Rosette: 4000 columns of six lasers, 0.42 deg apart, within a cone of 35.2 deg half angle around x. Each beam goes
/// through two prisms that turn in opposite directions at 7294 and 4664 rpm (Livox Avia, field of view 70.4 deg,
/// 240 000 points per second), so that sweeps do not repeat.
///
/// Immutable, hence thread-safe.
class LidarPattern {
 public:
  static constexpr double kPeriod = 0.1;  ///< s

  explicit LidarPattern(const LidarModel& model);

  int rings() const { return rings_; }
  int columns() const { return columns_; }
  /// Returns the time of a beam since the begin of its sweep, s, in [0, kPeriod).
  double time(int column, int ring) const;
  /// Returns the nominal elevation of a laser, rad; for a rosette relative to the centre of its lasers.
  double elevation(int ring) const;
  /// Returns the unit vector of a beam of the `sweep`-th sweep; `elevation_error`: rad, added to elevation().
  Eigen::Vector3d direction(std::uint64_t sweep, int column, int ring, double elevation_error = 0.0) const;

 private:
  LidarModel::Pattern pattern_;
  int rings_, columns_;
};

}  // namespace urban_nav_sim
