// SPDX-License-Identifier: BSD-3-Clause
#include "edits/edited_map.hpp"

#include <algorithm>
#include <cmath>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/ground_views.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/stored_fixes.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr double kKnown = 1e-9;  // share of the best determined direction

/// Returns the parameters of stage graph stored by the run that relaxed a session, without obsolete rows.
pose_graph::Parameters storedParameters(Store& store, const SessionId& id) {
  const std::string prefix = pose_graph::table().stage() + ".";
  std::vector<urban_nav_core::Assignment> assignments;
  for (const urban_nav_store::StoredParameter& row : store.sessions().parameters(id)) {
    if (row.name.rfind(prefix, 0) != 0) continue;
    const std::string name = row.name.substr(prefix.size());
    const auto& rows = pose_graph::table().rows();
    if (std::any_of(rows.begin(), rows.end(), [&](const auto& known) { return known.name == name; }))
      assignments.push_back(urban_nav_core::parseSetting(row.name + "=" + row.value));
  }
  return urban_nav_core::load(pose_graph::table(), assignments).parameters;
}

bool isSame(const Pose& a, const Pose& b) { return a.t() == b.t() && a.q().coeffs() == b.q().coeffs(); }

}  // namespace

StoredMeasurements readMeasurements(Store& store) {
  StoredMeasurements result;
  result.sessions = readPreviousSessions(store, {});
  if (result.sessions.ids.empty()) throw urban_nav_core::DataError(store.path(), "has no session with poses", "");
  result.closures = closuresBetween(store, result.sessions.ids, result.sessions.names);
  result.parameters = storedParameters(store, result.sessions.ids.back());
  for (const SessionId& id : result.sessions.ids) {
    result.grounds.push_back(pose_graph::readGround(store, id));
    if (result.parameters.gps) result.fixes.push_back(urban_nav_store::readFixes(store, id));
  }
  return result;
}

GraphRun relaxEdited(const StoredMeasurements& measurements, const std::vector<pose_graph::Edit>& edits) {
  std::vector<const SessionOdometry*> runs;
  for (const SessionOdometry& run : measurements.sessions.runs) runs.push_back(&run);
  return runGraph(measurements.parameters, runs, measurements.sessions.names, {}, measurements.closures,
                  measurements.grounds, measurements.fixes, {}, edits);
}

MapFigures readFigures(const GraphRun& run) {
  const pose_graph::PoseGraph& graph = run.graph;
  pose_graph::Problem<3> problem = graph.problem();
  std::vector<pose_graph::Rigid<3>> poses;
  for (const pose_graph::Track& track : graph.tracks())
    for (const Pose& pose : track.map) poses.push_back(pose_graph::toRigid<3>(pose));
  // The relaxation may have scaled variances; figures use the measured ones, so that they are comparable.
  const double closure_factor = graph.selection().rescaled ? graph.selection().closure_factor : 1.0;
  pose_graph::Problem<3> planes = problem.withoutEdges();
  std::size_t e = 0, directions = 0;
  for (; e < problem.edges.size() - graph.closures().size(); ++e)
    problem.edges[e].information *= graph.odometryVariance();
  for (const auto& [id, closure] : graph.closures()) {
    pose_graph::Edge<3>& edge = problem.edges[e++];
    if (!pose_graph::isVouchedFor(closure)) edge.information *= closure_factor;
    if (closure.kind != pose_graph::EdgeKind::Plane) continue;
    planes.edges.push_back(edge);
    if (const auto values = urban_nav_core::symmetricEigenvalues(edge.information))
      directions += static_cast<std::size_t>((values->array() > kKnown * values->maxCoeff()).count());
  }
  MapFigures figures;
  figures.cost = pose_graph::cost(problem, poses, pose_graph::Objective::Geodesic, graph.weights());
  if (directions > 0)
    figures.planes_over_noise =
        std::sqrt(pose_graph::cost(planes, poses, pose_graph::Objective::Geodesic) / static_cast<double>(directions));
  return figures;
}

PoseMoves comparePoses(const MapPoses& before, const MapPoses& after) {
  PoseMoves moves;
  double sum = 0.0;
  std::size_t poses = 0;
  for (std::size_t s = 0; s < before.size(); ++s) {
    if (before[s].empty() || after[s].empty()) continue;  // a single frame is not part of the graph
    moves.any = moves.any || before[s].size() != after[s].size();
    for (std::size_t i = 0; i < std::min(before[s].size(), after[s].size()); ++i) {
      const double distance = (before[s][i].pose.t() - after[s][i].pose.t()).norm();
      moves.any = moves.any || !isSame(before[s][i].pose, after[s][i].pose);
      moves.largest = std::max(moves.largest, distance);
      sum += distance * distance;
      ++poses;
    }
  }
  if (poses > 0) moves.rms = std::sqrt(sum / static_cast<double>(poses));
  return moves;
}

MapPoses storedPoses(Store& store, const std::vector<SessionId>& ids) {
  MapPoses poses;
  for (const SessionId& id : ids) {
    Trajectory trajectory;
    for (const urban_nav_core::StampedPose& pose : readTrajectory(store, *store.sessions().find(id)).T_map_base)
      trajectory.append(pose.stamp, pose.pose);
    poses.push_back(std::move(trajectory));
  }
  return poses;
}

MapPoses relaxedPoses(const GraphRun& run) {
  MapPoses poses;
  for (std::size_t s = 0; s < run.sessions.size(); ++s) poses.push_back(run.trajectory(s));
  return poses;
}

}  // namespace urban_nav
