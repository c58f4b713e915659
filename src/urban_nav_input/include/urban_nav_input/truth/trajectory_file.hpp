// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_input {

/// A trajectory from a file: with stamps (TUM, EuRoC) or without (KITTI lines).
struct TrajectoryFile {
  std::string path;
  bool stamped = true;
  urban_nav_core::Trajectory trajectory;    ///< if stamped
  std::vector<urban_nav_core::Pose> poses;  ///< always; KITTI poses with the axes of base_link (REP-103)
  std::vector<std::string> notes = {};      ///< for the user: lines that were sorted or left out, units of stamps
};

/// Converts a pose between optical frames to body axes.
urban_nav_core::Pose opticalToBody(const urban_nav_core::Pose& T_first_camera);

/// Reads .tum, .kitti, .txt (8 columns: TUM's, 12: KITTI's) and .csv (EuRoC's ground truth: stamp in ns, position,
/// quaternion w x y z). Throws UserError with file and line, DataError for a file without poses.
TrajectoryFile readTrajectory(const std::string& path);

}  // namespace urban_nav_input
