// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/io/covariance_csv.hpp"
#include "urban_nav_input/truth/trajectory_file.hpp"

namespace urban_nav {

/// Covariances of a run for one of its trajectories, or the reason why they are missing.
struct RunCovariances {
  std::vector<urban_nav_core::CovarianceRow> rows;
  std::string warning;  ///< for the user; empty without a problem or without covariance.csv
};

/// Reads covariance.csv in the folder of `estimate`, whose rows are of base_link. KITTI lines are poses of the left
/// camera, which have the same covariances only if the mounting is a pure change of axes: returns no rows unless the
/// motion is that of trajectory.tum in the same folder. The caller checks that the number of rows is that of the poses.
RunCovariances readRunCovariances(const urban_nav_input::TrajectoryFile& estimate);

}  // namespace urban_nav
