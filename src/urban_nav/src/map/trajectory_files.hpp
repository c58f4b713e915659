// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/session_trajectory.hpp"
#include "map/stage_result.hpp"

namespace urban_nav {

/// Names of the files that trajectoryFiles() returns; "#" stands for fileSuffix().
const std::vector<std::string>& trajectoryFileNames();

/// Returns the files with the poses of a run: trajectory.tum, trajectory.kitti, covariance.csv,
/// relative_covariance.csv. Sessions of one map follow each other in the files of its first session. The poses of
/// --localise replace those of trajectory.tum alone. `runs`, `trajectories`: one per session; both must outlive the
/// files.
///
/// A frame that was dropped because of its stamp has a line in trajectory.kitti, with the pose before it, so that lines
/// and images count alike; the other files are indexed by stamp and leave it out.
std::vector<OutputFile> trajectoryFiles(const std::vector<const SessionOdometry*>& runs,
                                        const std::vector<SessionTrajectory>& trajectories);

}  // namespace urban_nav
