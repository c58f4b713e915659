// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph_file.hpp"

#include <algorithm>
#include <cmath>

#include "file/constraints.hpp"
#include "file/information.hpp"
#include "start/along_edges.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::G2oGraph;
using urban_nav_core::Pose;
using urban_nav_core::UserError;

namespace {

std::vector<G2oGraph::Id> listIds(const G2oGraph& graph) {
  std::vector<G2oGraph::Id> ids;
  ids.reserve(graph.vertices.size() + 2 * graph.edges.size());
  for (const G2oGraph::Vertex& vertex : graph.vertices) ids.push_back(vertex.id);
  for (const G2oGraph::Edge& edge : graph.edges) {
    ids.push_back(edge.from);
    ids.push_back(edge.to);
  }
  for (const G2oGraph::PointEdge& edge : graph.point_edges) ids.push_back(edge.from);
  for (const G2oGraph::Prior& prior : graph.priors) ids.push_back(prior.vertex);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

int findNumber(const std::vector<G2oGraph::Id>& ids, G2oGraph::Id id) {
  return static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

}  // namespace

template <int D>
Rigid<D> toRigid(const Pose& pose) {
  return {pose.R().template topLeftCorner<D, D>(), pose.t().template head<D>()};
}

Pose toPose(const Rigid<2>& T) {
  const double half = 0.5 * std::atan2(T.R(1, 0), T.R(0, 0));
  return Pose(Eigen::Quaterniond(std::cos(half), 0.0, 0.0, std::sin(half)), {T.t.x(), T.t.y(), 0.0});
}
Pose toPose(const Rigid<3>& T) { return Pose(T.R, T.t); }

namespace {

void refuseEdgesToLandmarks(const G2oGraph& graph, const std::vector<G2oGraph::Id>& ids, const std::string& name) {
  const auto refuse = [&](G2oGraph::Id id) {
    if (std::binary_search(ids.begin(), ids.end(), id))
      throw UserError(name, "vertex " + std::to_string(id) + " is both a landmark and a pose",
                      "different ids for landmarks and poses");
  };
  for (const G2oGraph::Point& point : graph.points) refuse(point.id);
  for (const G2oGraph::PointEdge& edge : graph.point_edges) refuse(edge.to);
}

template <int D>
void readEdges(const G2oGraph& graph, const std::string& name, Semidefinite demanded, FileProblem<D>& made) {
  made.problem.edges.reserve(graph.edges.size());
  std::size_t indefinite = 0, to_itself = 0;
  for (const G2oGraph::Edge& edge : graph.edges) {
    TangentMatrix<D> information = tangentInformation<D>(edge.information);
    const std::string what = "the edge from " + std::to_string(edge.from) + " to " + std::to_string(edge.to);
    indefinite += demandSemidefinite<D>(demanded, information, what, name) ? 0 : 1;
    if (edge.from == edge.to) {
      ++to_itself;
      made.edges.push_back(-1);
      continue;
    }
    made.edges.push_back(static_cast<int>(made.problem.edges.size()));
    made.problem.edges.push_back(
        {findNumber(made.ids, edge.from), findNumber(made.ids, edge.to), toRigid<D>(graph.pose(edge)), information});
  }
  if (indefinite > 0)
    made.notes.push_back(
        std::to_string(indefinite) +
        " edges have information with a negative eigenvalue: only its translation and rotation blocks are used");
  if (to_itself > 0) made.notes.push_back(std::to_string(to_itself) + " edges from a vertex to itself are ignored");
}

template <int D>
void placeVertices(const G2oGraph& graph, FileProblem<D>& made) {
  made.problem.poses.resize(made.ids.size());
  std::vector<char> listed(made.ids.size(), 0);
  for (const G2oGraph::Vertex& vertex : graph.vertices) {
    const std::size_t i = static_cast<std::size_t>(findNumber(made.ids, vertex.id));
    made.problem.poses[i] = toRigid<D>(graph.pose(vertex));
    listed[i] = 1;
  }
  const auto missing = static_cast<std::size_t>(std::count(listed.begin(), listed.end(), 0));
  if (missing == 0) return;
  if (missing == listed.size()) {
    made.notes.push_back("no VERTEX lines: the initial guess follows the edges");
    made.problem.poses = posesAlongEdges(made.problem);
    return;
  }
  const std::size_t first = static_cast<std::size_t>(std::find(listed.begin(), listed.end(), 0) - listed.begin());
  made.notes.push_back(std::to_string(missing) + " vertices have no VERTEX line, the first is " +
                       std::to_string(made.ids[first]) + ": their initial guess follows the edges");
  const std::vector<Rigid<D>> along = posesAlongEdges(made.problem, listed);
  for (std::size_t i = 0; i < listed.size(); ++i)
    if (!listed[i]) made.problem.poses[i] = along[i];
}

}  // namespace

template <int D>
FileProblem<D> makeProblem(const G2oGraph& graph, const std::string& name, Semidefinite demanded) {
  if (graph.edges.empty() && graph.point_edges.empty() && graph.priors.empty())
    throw UserError(name, "a graph without edges", "EDGE_SE2 or EDGE_SE3:QUAT lines");
  FileProblem<D> made;
  made.ids = listIds(graph);
  refuseEdgesToLandmarks(graph, made.ids, name);
  readEdges(graph, name, demanded, made);
  placeVertices(graph, made);
  made.roles = rolesByNumbers(made.problem);
  addConstraints(graph, name, demanded, made);
  return made;
}

template <int D>
G2oGraph withPoses(const G2oGraph& graph, const FileProblem<D>& file, const std::vector<Rigid<D>>& poses) {
  G2oGraph made = graph;
  std::vector<char> listed(file.ids.size(), 0);
  const auto isFixed = [&](std::size_t i) {
    return std::binary_search(file.problem.fixed.begin(), file.problem.fixed.end(), static_cast<int>(i));
  };
  for (G2oGraph::Vertex& vertex : made.vertices) {
    const std::size_t i = static_cast<std::size_t>(findNumber(file.ids, vertex.id));
    if (!isFixed(i)) made.setPose(vertex, toPose(poses[i]));
    listed[i] = 1;
  }
  for (std::size_t i = 0; i < listed.size(); ++i) {
    if (listed[i]) continue;
    G2oGraph::Vertex vertex;
    vertex.id = file.ids[i];
    made.setPose(vertex, toPose(poses[i]));
    made.vertices.push_back(vertex);
  }
  for (std::size_t k = 0; k < file.point_ids.size(); ++k) {
    const std::size_t i = file.ids.size() + k;
    const urban_nav_core::Vector3d at = toPose(poses[i]).t();
    if (k >= made.points.size()) made.points.push_back({file.point_ids[k], {}});
    G2oGraph::Point& point = made.points[k];
    if (!isFixed(i)) point.values = {at.x(), at.y(), D == 2 ? 0.0 : at.z()};
  }
  return made;
}

template Rigid<2> toRigid<2>(const Pose&);
template Rigid<3> toRigid<3>(const Pose&);
template FileProblem<2> makeProblem<2>(const G2oGraph&, const std::string&, Semidefinite);
template FileProblem<3> makeProblem<3>(const G2oGraph&, const std::string&, Semidefinite);
template G2oGraph withPoses<2>(const G2oGraph&, const FileProblem<2>&, const std::vector<Rigid<2>>&);
template G2oGraph withPoses<3>(const G2oGraph&, const FileProblem<3>&, const std::vector<Rigid<3>>&);

}  // namespace pose_graph
