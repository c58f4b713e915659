// SPDX-License-Identifier: BSD-3-Clause
#include "linear_system.hpp"

namespace pose_graph {
namespace {

template <int D>
double weighted(const Edge<D>& edge, const Tangent<D>& e) {
  return e.dot(edge.information * e);
}

}  // namespace

template <int D>
ChainState<D> makeState(const std::vector<Rigid<D>>& poses) {
  ChainState<D> state;
  for (std::size_t i = 1; i < poses.size(); ++i) state.links.push_back(chained(poses[i - 1].inverse(), poses[i]));
  if (!poses.empty()) state.poses.push_back(poses.front());
  for (const Rigid<D>& link : state.links) state.poses.push_back(chained(state.poses.back(), link));
  return state;
}

template <int D>
ChainState<D> moved(const ChainState<D>& state, const Increments<D>& step) {
  ChainState<D> next;
  next.links.reserve(state.links.size());
  next.poses.reserve(state.poses.size());
  next.poses.push_back(state.poses.front());
  for (std::size_t i = 0; i < state.links.size(); ++i) {
    next.links.push_back(moved<D>(state.links[i], Tangent<D>(step.col(static_cast<Eigen::Index>(i)))));
    next.poses.push_back(chained(next.poses.back(), next.links.back()));
  }
  return next;
}

template <int D>
double computeCost(const Problem<D>& problem, const ChainState<D>& state) {
  double cost = 0.0;
  for (const Edge<D>& edge : problem.edges) {
    const auto& from = state.poses[static_cast<std::size_t>(edge.from)];
    const auto& to = state.poses[static_cast<std::size_t>(edge.to)];
    cost += weighted<D>(edge, edgeResidual(edge, from, to));
  }
  return cost;
}

template <int D>
LinearSystem<D>::LinearSystem(const Problem<D>& problem, const Chain<D>& chain, const ChainState<D>& state)
    : poses_(state.poses) {
  const Eigen::Index links = chain.links;
  blocks_.assign(static_cast<std::size_t>(links), TangentMatrix<D>::Zero());
  b_ = Increments<D>::Zero(kTangentSize<D>, links);
  for (const auto& [link, i] : chain.link_edges) {
    // In the frame of the link's first pose, where round-off is smallest.
    const Edge<D>& edge = problem.edges[i];
    const Rigid<D> first, second = state.links[static_cast<std::size_t>(link)];
    const bool forwards = edge.from < edge.to;
    const EdgeRow<D> row = edgeRow(edge, forwards ? first : second, forwards ? second : first);
    const TangentMatrix<D> J = (forwards ? 1.0 : -1.0) * row.K * pose_graph::linkMatrix<D>(first, second.t);
    const TangentMatrix<D> WJ = edge.information * J;
    blocks_[static_cast<std::size_t>(link)] += J.transpose() * WJ;
    b_.col(link) -= WJ.transpose() * row.e;
    cost_ += weighted<D>(edge, row.e);
  }
  Increments<D> pull = Increments<D>::Zero(kTangentSize<D>, links + 1);
  rows_.reserve(chain.closures.size());
  for (const auto& [i, root] : chain.closures) {
    const Edge<D>& edge = problem.edges[i];
    const EdgeRow<D> row =
        edgeRow(edge, poses_[static_cast<std::size_t>(edge.from)], poses_[static_cast<std::size_t>(edge.to)]);
    rows_.push_back({edge.from, edge.to, root * row.K});
    const Tangent<D> z = rows_.back().G.transpose() * (root * row.e);
    pull.col(edge.to) -= z;
    pull.col(edge.from) += z;
    cost_ += weighted<D>(edge, row.e);
  }
  Increments<D> force(kTangentSize<D>, links);
  sweepBack(pull, force);
  b_ += force;
}

template <int D>
void LinearSystem<D>::sweep(const Increments<D>& step, Increments<D>& x) const {
  x.resize(Eigen::NoChange, step.cols() + 1);
  x.col(0).setZero();
  for (Eigen::Index i = 0; i < step.cols(); ++i) {
    const auto r = static_cast<std::size_t>(i);
    x.col(i + 1) = x.col(i) + linkTwist<D>(poses_[r], poses_[r + 1].t, Tangent<D>(step.col(i)));
  }
}

template <int D>
void LinearSystem<D>::sweepBack(const Increments<D>& pull, Increments<D>& force) const {
  force.resize(Eigen::NoChange, pull.cols() - 1);
  Tangent<D> following = Tangent<D>::Zero();
  for (Eigen::Index i = pull.cols() - 2; i >= 0; --i) {
    const auto r = static_cast<std::size_t>(i);
    following += pull.col(i + 1);
    force.col(i) = linkForce<D>(poses_[r], poses_[r + 1].t, following);
  }
}

template <int D>
void LinearSystem<D>::apply(double damping, const Increments<D>& step, Increments<D>& result,
                            Increments<D>& scratch) const {
  sweep(step, scratch);
  // All closures read x before it is overwritten by their forces.
  std::vector<Tangent<D>> pulls;
  pulls.reserve(rows_.size());
  for (const Row& row : rows_)
    pulls.push_back(row.G.transpose() * (row.G * (scratch.col(row.to) - scratch.col(row.from))));
  scratch.setZero();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    scratch.col(rows_[i].to) += pulls[i];
    scratch.col(rows_[i].from) -= pulls[i];
  }
  sweepBack(scratch, result);
  for (Eigen::Index i = 0; i < step.cols(); ++i)
    result.col(i) += (1.0 + damping) * (blocks_[static_cast<std::size_t>(i)] * step.col(i));
}

template <int D>
TangentMatrix<D> LinearSystem<D>::linkMatrix(int link) const {
  const auto r = static_cast<std::size_t>(link);
  return pose_graph::linkMatrix<D>(poses_[r], poses_[r + 1].t);
}

template ChainState<2> makeState(const std::vector<Rigid<2>>&);
template ChainState<3> makeState(const std::vector<Rigid<3>>&);
template ChainState<2> moved(const ChainState<2>&, const Increments<2>&);
template ChainState<3> moved(const ChainState<3>&, const Increments<3>&);
template double computeCost(const Problem<2>&, const ChainState<2>&);
template double computeCost(const Problem<3>&, const ChainState<3>&);
template class LinearSystem<2>;
template class LinearSystem<3>;

}  // namespace pose_graph
