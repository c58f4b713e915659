// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/output_folder.hpp"
#include "stages/graph/graph_stage.hpp"

namespace urban_nav {

/// The files of docs/files.md as they are after relaxation: trajectory.tum, trajectory.kitti, covariance.csv and
/// relative_covariance.csv of all sessions that lie in one map, one after another; trajectory_2.tum and so on of a map that the
/// second session begins. graph.g2o and closures.csv hold everything. Files that visual odometry wrote of the other sessions are
/// removed. `runs`: one for each session of the graph.
void writeGraphFiles(const OutputFolder& folder, const GraphRun& graph, const std::vector<const VoRun*>& runs);

}  // namespace urban_nav
