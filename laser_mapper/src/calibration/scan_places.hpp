// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "calibration/calibration_terms.hpp"
#include "calibration/sampled_scans.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Correction of a pose by boxPlus(): translation, then rotation vector, in the axes of the map.
using PoseCorrection = urban_nav_core::Vector6d;

/// Pose of a scan, with the motion around its middle.
struct ScanPlace {
  bool is_known = false;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();          ///< of the robot in the map, m
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();         ///< from the robot to the laser, axes of the map
  Eigen::Matrix3d R_map_stated = Eigen::Matrix3d::Zero();  ///< of the laser's frame as stated
  Eigen::Matrix3d R_map_laser = Eigen::Matrix3d::Zero();   ///< of the laser
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< m/s
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();     ///< rad/s
  double share = 0.0;  ///< weight of the correction at the end of the scan's window; 1 - share is that of the one at
                       ///< its beginning

  /// Returns the end of a beam relative to the robot, axes of the map.
  Eigen::Vector3d fromRobot(const SampledScans::Beam& beam) const {
    const Eigen::Vector3d m = lever + R_map_laser * beam.ray.cast<double>();
    return m + static_cast<double>(beam.seconds) * turn_rate.cross(m);
  }
  /// Returns the end of a beam in the map.
  Eigen::Vector3d inMap(const SampledScans::Beam& beam) const {
    return base + static_cast<double>(beam.seconds) * velocity + fromRobot(beam);
  }
};

/// Returns the poses of all scans with the given terms of each laser and corrections of the trajectory at integer
/// seconds. Scans at times without a pose have none.
std::vector<ScanPlace> placeScans(const SampledScans& samples, const std::vector<MountedLaser>& lasers,
                                  const std::vector<TermVector>& terms, const urban_nav_core::Trajectory& T_map_base,
                                  const std::vector<PoseCorrection>& corrections, urban_nav_core::StampNs max_gap);

}  // namespace laser_mapper
