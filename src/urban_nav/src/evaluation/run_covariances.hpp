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
  std::string warning;  ///< for the user; empty where all is well or the run has no covariance.csv
};

/// Reads covariance.csv in the folder of `estimate`. Its rows are of base_link. Lines of KITTI are poses of the left
/// camera and have these covariances only if the mounting is a pure change of axes: where the poses are not those of
/// trajectory.tum in the same folder, there are no rows. A number of rows other than that of the poses is the caller's
/// to report.
RunCovariances readRunCovariances(const urban_nav_input::TrajectoryFile& estimate);

}  // namespace urban_nav
