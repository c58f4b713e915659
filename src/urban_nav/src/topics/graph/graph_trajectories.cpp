// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph_trajectories.hpp"

namespace urban_nav {

std::vector<SessionTrajectory> relaxedTrajectories(const GraphRun& graph, std::vector<SessionTrajectory> odometry) {
  for (std::size_t s = 0; s < odometry.size(); ++s) {
    SessionTrajectory& session = odometry[s];
    session.written = true;
    session.map = graph.findMap(s);
    urban_nav_core::Trajectory trajectory = graph.trajectory(s);
    if (trajectory.empty()) continue;
    session.T_map_base = std::move(trajectory);
    session.covariances = graph.covariances[s];
  }
  return odometry;
}

}  // namespace urban_nav
