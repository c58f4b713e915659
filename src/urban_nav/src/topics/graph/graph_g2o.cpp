// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph_g2o.hpp"

#include "pose_graph/graph_file.hpp"
#include "urban_nav_core/io/g2o.hpp"

namespace urban_nav {

using urban_nav_core::G2oGraph;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

namespace {

/// Returns the problem with its vertices at their relaxed poses, without rejected closures.
G2oGraph relaxedProblem(const GraphRun& run) {
  G2oGraph made;
  G2oGraph::Id id = 0;
  for (std::size_t s = 0; s < run.sessions.size(); ++s) {
    for (const urban_nav_core::StampedPose& pose : run.trajectory(s)) {
      G2oGraph::Vertex vertex;
      vertex.id = id++;
      made.setPose(vertex, pose.pose);
      made.vertices.push_back(vertex);
    }
  }
  const pose_graph::Problem<3> problem = run.graph.problem();
  const std::vector<double> weights = run.graph.weights();
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    if (weights[e] == 0.0) continue;
    const pose_graph::Edge<3>& edge = problem.edges[e];
    G2oGraph::Edge line;
    line.from = edge.from;
    line.to = edge.to;
    const Pose Z = toPose(edge.Z);
    line.values = {Z.t().x(), Z.t().y(), Z.t().z(), Z.q().x(), Z.q().y(), Z.q().z(), Z.q().w()};
    Matrix6d information =
        edge.information;  // of the rotation vector; the file uses the vector part of the quaternion, half of it
    information.topRightCorner<3, 3>() *= 2.0;
    information.bottomLeftCorner<3, 3>() *= 2.0;
    information.bottomRightCorner<3, 3>() *= 4.0;
    urban_nav_core::setG2oInformation(line, information);
    made.edges.push_back(line);
  }
  if (!made.vertices.empty()) made.fixed.push_back(0);
  return made;
}

}  // namespace

std::string graphG2o(const GraphRun& run) { return urban_nav_core::printG2o(relaxedProblem(run)); }

}  // namespace urban_nav
