// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pipeline/output_folder.hpp"
#include "stages/vo/vo_stage.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav {

/// The files of docs/files.md that visual odometry makes: trajectory.tum, trajectory.kitti, covariance.csv,
/// relative_covariance.csv, graph.g2o, landmarks.ply. All hold settled poses. `suffix` ("", "_2") stands before the
/// extension.
///
/// A frame that was dropped because of its stamp has a line in trajectory.kitti, with the pose before it, so that lines
/// and images count alike; elsewhere, where lines are found by stamp, it has none.
void writeVoFiles(const OutputFolder& folder, const VoRun& run, const std::string& suffix);

/// Files of the same names that an earlier run with more sessions left.
enum class VoFiles { All, AllButLandmarks };
void removeVoFiles(const OutputFolder& folder, const std::string& suffix, VoFiles which = VoFiles::All);

/// stats.csv: a row per frame of all sessions.
std::string statsCsv(const std::vector<const VoRun*>& runs);

/// The settled poses of base_link.
urban_nav_core::Trajectory trajectoryOf(const VoRun& run);
/// The settled steps between them.
urban_nav_core::OdometryChain odometryOf(const VoRun& run);

std::string trajectoryTum(const VoRun& run);
std::string trajectoryKitti(const VoRun& run);
std::string covarianceCsv(const VoRun& run);
std::string relativeCovarianceCsv(const VoRun& run);
std::string graphG2o(const VoRun& run);
/// Binary: float x y z (m, `odom`), float sigma (m, along the line of sight), uchar red green blue. Landmarks seen in
/// at least three frames.
std::string landmarksPly(const VoRun& run);

}  // namespace urban_nav
