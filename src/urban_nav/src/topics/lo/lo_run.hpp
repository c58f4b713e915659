// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_odometry/laser_odometry.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_core/motion/motion_estimates.hpp"

namespace urban_nav {

/// Figures of one sweep, for sweeps.csv and the report.
struct LoFigures {
  laser_odometry::Statistics statistics;
  std::vector<urban_nav_core::Vector6d> free_directions;  ///< as LaserPose has them
  double process_ms = 0.0;
};

/// Laser odometry of one session.
struct LoRun : SessionOdometry {
  std::string role;                        ///< of the LiDAR: "points0", "laser0"; empty before its first sweep
  bool is_planar = false;                  ///< by a planar laser: planar motion only
  std::vector<LoFigures> figures;          ///< one per element of `frames`
  urban_nav_core::MotionEstimates motion;  ///< gyroscope and wheels compared with the sweeps, as known at the end
  std::vector<Eigen::Vector3f> surface;    ///< planes along the path, for the picture from above; m, in odom
};

}  // namespace urban_nav
