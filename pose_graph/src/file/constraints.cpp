// SPDX-License-Identifier: BSD-3-Clause
#include "file/constraints.hpp"

#include <algorithm>
#include <map>

#include "file/information.hpp"
#include "linear/index.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::G2oGraph;
using urban_nav_core::UserError;

namespace {

template <int D>
class ConstraintAdder {
 public:
  ConstraintAdder(const G2oGraph& graph, const std::string& name, Semidefinite demanded, FileProblem<D>& file)
      : graph_(graph), name_(name), demanded_(demanded), file_(file) {
    for (const G2oGraph::Offset& offset : graph.offsets) offsets_[offset.id] = toRigid<D>(graph.pose(offset));
  }

  void addLandmarks() {
    for (const G2oGraph::Point& point : graph_.points) {
      Rigid<D> pose;
      for (int a = 0; a < D; ++a) pose.t[a] = point.values[sz(a)];
      landmark_[point.id] = addPose(pose);
      file_.point_ids.push_back(point.id);
    }
    std::vector<char> placed(file_.problem.poses.size(), 1), tied(file_.problem.poses.size(), 0);
    for (const G2oGraph::PointEdge& measured : graph_.point_edges) {
      if (!landmark_.count(measured.to)) {
        landmark_[measured.to] = addPose({});
        file_.point_ids.push_back(measured.to);
        placed.push_back(0);
        tied.push_back(0);
      }
      addLandmarkObservation(measured, placed, tied);
    }
  }

  void addPriors() {
    for (const G2oGraph::Prior& prior : graph_.priors) {
      Edge<D> edge;
      edge.Z = toRigid<D>(graph_.pose(prior));
      edge.information = priorInformation(prior);
      demandSemidefinite<D>(demanded_, edge.information, "the prior of " + std::to_string(prior.vertex), name_);
      edge.to = poseOrLandmark(prior.vertex);
      if constexpr (D == 3) mount(edge, offset(prior.parameter));
      edge.from = frame();
      file_.priors.push_back(static_cast<int>(file_.problem.edges.size()));
      add(edge, EdgeRole::Asserted);
    }
  }

  void fixVertices() {
    std::vector<G2oGraph::Id> fixed = graph_.fixed;
    std::sort(fixed.begin(), fixed.end());
    fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
    // A single fixed vertex that is held anyway needs no constraint.
    if (graph_.priors.empty() && fixed.size() == 1 && fixed.front() == file_.ids.front()) return;
    for (const G2oGraph::Id id : fixed) {
      const int pose = poseOrLandmark(id);
      if (pose < 0) {
        file_.notes.push_back("FIX names vertex " + std::to_string(id) + ", which does not exist");
        continue;
      }
      file_.problem.fixed.push_back(pose);
      frame();
      if (landmark_.count(id)) releaseRotation(pose);
    }
    std::sort(file_.problem.fixed.begin(), file_.problem.fixed.end());
  }

 private:
  static constexpr int kTurn = kTangentSize<D> - D;

  int addPose(const Rigid<D>& pose) {
    file_.problem.poses.push_back(pose);
    return static_cast<int>(file_.problem.poses.size()) - 1;
  }

  void add(const Edge<D>& edge, EdgeRole role) {
    file_.problem.edges.push_back(edge);
    file_.roles.push_back(role);
  }

  int frame() {
    if (file_.frame < 0) file_.problem.fixed.push_back(file_.frame = addPose({}));
    return file_.frame;
  }

  // A fixed landmark has a position, but no rotation relative to which a pose could be measured.
  void releaseRotation(int landmark) {
    for (const int e : file_.point_edges) {
      Edge<D>& edge = file_.problem.edges[sz(e)];
      if (edge.to != landmark || file_.roles[sz(e)] != EdgeRole::Trusted) continue;
      edge.information.template bottomRightCorner<kTurn, kTurn>().setZero();
      file_.roles[sz(e)] = EdgeRole::Asserted;
    }
  }

  // E = Z^-1 T M of the sensor at M is, except for the lever arm, a measurement of T: rotated by M it has the same
  // error.
  static void mount(Edge<D>& edge, const Rigid<D>& M) {
    edge.lever = M.t;
    edge.Z.R = edge.Z.R * M.R.transpose();
    TangentMatrix<D> turn = TangentMatrix<D>::Zero();
    turn.template topLeftCorner<D, D>() = M.R.transpose();
    if constexpr (D == 3) turn.template bottomRightCorner<3, 3>() = M.R.transpose();
    edge.information = (turn.transpose() * edge.information * turn).eval();
  }

  int poseOrLandmark(G2oGraph::Id id) const {
    const auto landmark = landmark_.find(id);
    if (landmark != landmark_.end()) return landmark->second;
    const auto at = std::lower_bound(file_.ids.begin(), file_.ids.end(), id);
    return at != file_.ids.end() && *at == id ? static_cast<int>(at - file_.ids.begin()) : -1;
  }

  const Rigid<D>& offset(G2oGraph::Id id) const {
    const auto at = offsets_.find(id);
    if (at == offsets_.end())
      throw UserError(name_, "parameter " + std::to_string(id) + " is not defined",
                      "a line PARAMS_SE3OFFSET " + std::to_string(id));
    return at->second;
  }

  void addLandmarkObservation(const G2oGraph::PointEdge& measured, std::vector<char>& placed, std::vector<char>& tied) {
    Eigen::Matrix<double, D, 1> at;
    for (int a = 0; a < D; ++a) at[a] = measured.values[sz(a)];
    Edge<D> edge;
    edge.from = poseOrLandmark(measured.from);
    edge.to = landmark_.at(measured.to);
    if constexpr (D == 3) edge.Z = offset(measured.parameter);
    edge.Z.t += edge.Z.R * at;
    edge.information.setZero();
    std::size_t next = 0;
    for (int row = 0; row < D; ++row)
      for (int column = row; column < D; ++column)
        edge.information(row, column) = edge.information(column, row) = measured.information[next++];
    const std::string what = "the edge from " + std::to_string(measured.from) + " to " + std::to_string(measured.to);
    demandSemidefinite<D>(Semidefinite::Whole, edge.information, what, name_);
    Rigid<D>& landmark = file_.problem.poses[sz(edge.to)];
    const Rigid<D> seen = file_.problem.poses[sz(edge.from)] * edge.Z;
    if (!placed[sz(edge.to)]) landmark.t = seen.t;
    placed[sz(edge.to)] = 1;
    const bool first = !tied[sz(edge.to)];
    if (first) {
      landmark.R = seen.R;
      const double weight = std::max(1e-300, edge.information.trace() / D);
      edge.information.template bottomRightCorner<kTurn, kTurn>().diagonal().setConstant(weight);
    }
    tied[sz(edge.to)] = 1;
    file_.point_edges.push_back(static_cast<int>(file_.problem.edges.size()));
    add(edge, first ? EdgeRole::Trusted : EdgeRole::Asserted);
  }

  TangentMatrix<D> priorInformation(const G2oGraph::Prior& prior) const {
    if (!prior.position) return tangentInformation<D>(prior.information);
    TangentMatrix<D> made = TangentMatrix<D>::Zero();
    made(0, 0) = prior.information[0];
    made(0, 1) = made(1, 0) = prior.information[1];
    made(1, 1) = prior.information[2];
    return made;
  }

  const G2oGraph& graph_;
  const std::string& name_;
  Semidefinite demanded_;
  FileProblem<D>& file_;
  std::map<G2oGraph::Id, int> landmark_;
  std::map<G2oGraph::Id, Rigid<D>> offsets_;
};

}  // namespace

template <int D>
void addConstraints(const G2oGraph& graph, const std::string& name, Semidefinite demanded, FileProblem<D>& file) {
  ConstraintAdder<D> adder(graph, name, demanded, file);
  adder.addLandmarks();
  adder.addPriors();
  adder.fixVertices();
}

template void addConstraints<2>(const G2oGraph&, const std::string&, Semidefinite, FileProblem<2>&);
template void addConstraints<3>(const G2oGraph&, const std::string&, Semidefinite, FileProblem<3>&);

}  // namespace pose_graph
