// SPDX-License-Identifier: BSD-3-Clause
#include "stages/graph/graph_files.hpp"

#include "pose_graph/graph_file.hpp"
#include "stages/vo/vo_files.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/covariance_csv.hpp"
#include "urban_nav_core/io/g2o.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"

namespace urban_nav {

using urban_nav_core::G2oGraph;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;

namespace {

std::string suffixOf(std::size_t session) { return session == 0 ? "" : "_" + std::to_string(session + 1); }

/// A line per stereo frame, dropped ones with the pose before them.
void appendKitti(std::vector<Pose>& lines, const VoRun& run, const Trajectory& trajectory, const Pose& T_first_map) {
  std::size_t next = 0;
  for (const VoRow& row : run.rows) {
    if (row.accepted || next == 0) {
      if (next >= trajectory.size()) return;
      lines.push_back(T_first_map * trajectory[next++].pose * run.T_base_camera);
    } else {
      lines.push_back(lines.back());
    }
  }
}

/// The whole problem that was relaxed, its vertices where they are now, closures that were rejected left out.
G2oGraph graphOf(const GraphRun& run) {
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
    const Pose Z = poseOf(edge.Z);
    line.values = {Z.t().x(), Z.t().y(), Z.t().z(), Z.q().x(), Z.q().y(), Z.q().z(), Z.q().w()};
    Matrix6d information =
        edge.information;  // of the rotation vector; the file has the quaternion's, which is half of it
    information.topRightCorner<3, 3>() *= 2.0;
    information.bottomLeftCorner<3, 3>() *= 2.0;
    information.bottomRightCorner<3, 3>() *= 4.0;
    urban_nav_core::setG2oInformation(line, information);
    made.edges.push_back(line);
  }
  if (!made.vertices.empty()) made.fixed.push_back(0);
  return made;
}

/// Of the map that begins with session `first`.
void writeMap(const OutputFolder& folder, const GraphRun& graph, const std::vector<const VoRun*>& runs,
              std::size_t first) {
  std::string tum, covariance = urban_nav_core::covarianceHeader(),
                   relative = urban_nav_core::relativeCovarianceHeader();
  std::vector<Pose> kitti;
  Pose T_first_map;
  for (std::size_t s = first; s < runs.size(); ++s) {
    if (graph.mapOf(s) != first || runs[s]->settled.empty()) continue;
    const Trajectory trajectory = graph.trajectory(s);
    if (s == first) T_first_map = (trajectory.front().pose * runs[s]->T_base_camera).inverse();
    tum += urban_nav_core::printTum(trajectory);
    appendKitti(kitti, *runs[s], trajectory, T_first_map);
    const std::vector<Matrix6d>& covariances = graph.covariances[s];
    for (std::size_t i = 0; i < covariances.size(); ++i)
      covariance += urban_nav_core::printCovarianceRow(
          urban_nav_core::CovarianceRow{trajectory[i].stamp, runs[s]->settled[i].status.health, covariances[i]});
    for (std::size_t i = 1; i < runs[s]->settled.size(); ++i) {
      const urban_nav_core::RelativePose& step = runs[s]->settled[i].from_previous;
      relative += urban_nav_core::printCovarianceRow(urban_nav_core::RelativeCovarianceRow{
          step.from, step.to, runs[s]->settled[i].status.health, step.covariance});
    }
  }
  folder.write("trajectory" + suffixOf(first) + ".tum", tum);
  folder.write("trajectory" + suffixOf(first) + ".kitti", urban_nav_core::printKitti(kitti));
  folder.write("covariance" + suffixOf(first) + ".csv", covariance);
  folder.write("relative_covariance" + suffixOf(first) + ".csv", relative);
}

}  // namespace

void writeGraphFiles(const OutputFolder& folder, const GraphRun& graph, const std::vector<const VoRun*>& runs) {
  for (std::size_t s = 0; s < runs.size(); ++s) {
    if (s > 0) folder.remove("graph" + suffixOf(s) + ".g2o");  // graph.g2o has all of them
    if (graph.mapOf(s) != s) {
      removeVoFiles(folder, suffixOf(s), VoFiles::AllButLandmarks);
    } else if (!graph.trajectory(s).empty()) {
      writeMap(folder, graph, runs, s);
    }
  }
  folder.write("graph.g2o", urban_nav_core::printG2o(graphOf(graph)));
  folder.write("closures.csv", printClosures(graph.closures));
}

}  // namespace urban_nav
