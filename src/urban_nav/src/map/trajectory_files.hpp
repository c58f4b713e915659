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
/// relative_covariance.csv. Sessions of one map follow each other in the files of its first session. With --localise,
/// trajectory.tum has the localised poses. `runs`, `trajectories`: one per session; both must outlive the
/// files.
///
/// A frame that was dropped because of its stamp repeats the previous pose in trajectory.kitti, so that line numbers
/// are image numbers; the other files, indexed by stamp, omit it.
std::vector<OutputFile> trajectoryFiles(const std::vector<const SessionOdometry*>& runs,
                                        const std::vector<SessionTrajectory>& trajectories);

}  // namespace urban_nav
