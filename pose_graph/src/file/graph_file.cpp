// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph_file.hpp"

#include <algorithm>
#include <cmath>

#include "start/along_edges.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::G2oGraph;
using urban_nav_core::Pose;
using urban_nav_core::UserError;

namespace {

constexpr double kPrintedRoundOff =
    1e-9;  // of the largest eigenvalue: what printing information with few digits may cost

template <int D>
TangentMatrix<D> toInformation(const G2oGraph::Edge& edge) {
  TangentMatrix<D> information = urban_nav_core::g2oInformation(edge, D);
  if constexpr (D == 3) {
    information.template topRightCorner<3, 3>() *= 0.5;
    information.template bottomLeftCorner<3, 3>() *= 0.5;
    information.template bottomRightCorner<3, 3>() *= 0.25;
  }
  return information;
}

template <int N>
bool isSemidefinite(const Eigen::Matrix<double, N, N>& information) {
  if constexpr (N == 1) {
    return information(0, 0) >= 0.0;
  } else {
    // Most matrices pass by their Cholesky factor, at a tenth of the price of eigenvalues.
    if (urban_nav_core::SmallCholesky<N>(information).succeeded()) return true;
    const auto values = urban_nav_core::symmetricEigenvalues(information);
    return values && (*values)[0] >= -kPrintedRoundOff * std::max(0.0, values->maxCoeff());
  }
}

/// False where it is not, and need not be.
template <int D>
bool demand(Semidefinite demanded, const TangentMatrix<D>& information, const G2oGraph::Edge& edge,
            const std::string& name) {
  if (isSemidefinite<tangent_size<D>>(information)) return true;
  constexpr int R = tangent_size<D> - D;
  if (demanded == Semidefinite::Blocks && isSemidefinite<D>(information.template topLeftCorner<D, D>()) &&
      isSemidefinite<R>(information.template bottomRightCorner<R, R>()))
    return false;
  throw UserError(name,
                  "the information of the edge from " + std::to_string(edge.from) + " to " + std::to_string(edge.to) +
                      " has a negative eigenvalue",
                  "positive semidefinite matrices");
}

std::vector<G2oGraph::Id> listIds(const G2oGraph& graph) {
  std::vector<G2oGraph::Id> ids;
  ids.reserve(graph.vertices.size() + 2 * graph.edges.size());
  for (const G2oGraph::Vertex& vertex : graph.vertices) ids.push_back(vertex.id);
  for (const G2oGraph::Edge& edge : graph.edges) {
    ids.push_back(edge.from);
    ids.push_back(edge.to);
  }
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

template <int D>
FileProblem<D> makeProblem(const G2oGraph& graph, const std::string& name, Semidefinite demanded) {
  if (graph.edges.empty()) throw UserError(name, "a graph without edges", "EDGE_SE2 or EDGE_SE3:QUAT lines");
  FileProblem<D> made;
  made.ids = listIds(graph);
  made.problem.edges.reserve(graph.edges.size());
  std::size_t indefinite = 0;
  for (const G2oGraph::Edge& edge : graph.edges) {
    const TangentMatrix<D> information = toInformation<D>(edge);
    indefinite += demand<D>(demanded, information, edge, name) ? 0 : 1;
    made.problem.edges.push_back(
        {findNumber(made.ids, edge.from), findNumber(made.ids, edge.to), toRigid<D>(graph.pose(edge)), information});
  }
  if (indefinite > 0)
    made.notes.push_back(std::to_string(indefinite) +
                         " edges have information with a negative eigenvalue: only its blocks are read");
  made.problem.poses.resize(made.ids.size());
  std::vector<char> listed(made.ids.size(), 0);
  for (const G2oGraph::Vertex& vertex : graph.vertices) {
    const std::size_t i = static_cast<std::size_t>(findNumber(made.ids, vertex.id));
    made.problem.poses[i] = toRigid<D>(graph.pose(vertex));
    listed[i] = 1;
  }
  const auto missing = static_cast<std::size_t>(std::count(listed.begin(), listed.end(), 0));
  if (missing == 0) return made;
  if (missing == listed.size()) {
    made.notes.push_back("no VERTEX lines: the first guess follows the edges");
    made.problem.poses = posesAlongEdges(made.problem);
    return made;
  }
  const std::size_t first = static_cast<std::size_t>(std::find(listed.begin(), listed.end(), 0) - listed.begin());
  made.notes.push_back(std::to_string(missing) + " vertices have no VERTEX line, the first is " +
                       std::to_string(made.ids[first]) + ": their first guess follows the edges");
  const std::vector<Rigid<D>> along = posesAlongEdges(made.problem, listed);
  for (std::size_t i = 0; i < listed.size(); ++i)
    if (!listed[i]) made.problem.poses[i] = along[i];
  return made;
}

template <int D>
G2oGraph withPoses(const G2oGraph& graph, const FileProblem<D>& file, const std::vector<Rigid<D>>& poses) {
  G2oGraph made = graph;
  std::vector<char> listed(file.ids.size(), 0);
  for (G2oGraph::Vertex& vertex : made.vertices) {
    const std::size_t i = static_cast<std::size_t>(findNumber(file.ids, vertex.id));
    made.setPose(vertex, toPose(poses[i]));
    listed[i] = 1;
  }
  for (std::size_t i = 0; i < listed.size(); ++i) {
    if (listed[i]) continue;
    G2oGraph::Vertex vertex;
    vertex.id = file.ids[i];
    made.setPose(vertex, toPose(poses[i]));
    made.vertices.push_back(vertex);
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
