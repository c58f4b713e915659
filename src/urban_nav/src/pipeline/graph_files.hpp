// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/graph_stage.hpp"
#include "pipeline/output_folder.hpp"

namespace urban_nav {

/// The files of CONTRACT.md as they are after relaxation: trajectory.tum, trajectory.kitti, covariance.csv,
/// relative_covariance.csv, graph.g2o and closures.csv of all sessions that joined, one after another. Those that did not keep what
/// visual odometry wrote, as trajectory_N.tum and so on; such files of sessions that joined are removed.
void writeGraphFiles(const OutputFolder& folder, const GraphRun& graph, const std::vector<const VoRun*>& runs);

}  // namespace urban_nav
