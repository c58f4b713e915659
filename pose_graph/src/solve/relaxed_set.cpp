// SPDX-License-Identifier: BSD-3-Clause
#include "solve/relaxed_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "linear/index.hpp"
#include "objective/whitened_edge.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace pose_graph {

namespace {

constexpr int kCoreRounds = 10;      // public graphs take at most four
constexpr double kNoSquares = 1e-9;  // chi-square

// Returns the log pseudo-determinant of an information matrix and its rank.
template <int D>
std::pair<double, int> logDeterminant(const TangentMatrix<D>& information) {
  const auto eigen = urban_nav_core::smallEigen<kTangentSize<D>>(information);
  const double largest = eigen.values[kTangentSize<D> - 1];
  double sum = 0.0;
  int rank = 0;
  for (int a = 0; a < kTangentSize<D>; ++a) {
    if (!(eigen.values[a] > kZeroEigenvalue * largest)) continue;
    sum += std::log(eigen.values[a]);
    ++rank;
  }
  return {sum, rank};
}

}  // namespace

template <int D>
RelaxedSet<D>::RelaxedSet(const Problem<D>& problem, const std::vector<EdgeRole>& roles)
    : problem_(&problem),
      roles_(&roles),
      core_(CoreGraph<D>::of(problem, roles)),
      whole_graph_(std::make_unique<AcceptedGraph<D>>(problem)) {
  std::pair<double, int> determinant;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    // Consecutive edges often have equal information.
    const TangentMatrix<D>& information = problem.edges[e].information;
    if (e == 0 || information != problem.edges[e - 1].information) determinant = logDeterminant<D>(information);
    log_information_.push_back(determinant.first);
    rank_.push_back(determinant.second);
  }
  if (!core_) return;
  core_graph_ = std::make_unique<AcceptedGraph<D>>(core_->problem());
  core_edge_.assign(roles.size(), -1);
  for (std::size_t c = 0; c < core_->problem().edges.size(); ++c)
    if (const int e = core_->edge(static_cast<int>(c)); e >= 0) core_edge_[sz(e)] = static_cast<int>(c);
}

template <int D>
std::vector<double> RelaxedSet<D>::weights() const {
  std::vector<double> weights(in_.size(), 0.0);
  for (std::size_t e = 0; e < weights.size(); ++e)
    if (in_[e]) weights[e] = 1.0 / varianceFactor(e);
  return weights;
}

template <int D>
void RelaxedSet<D>::relax(const std::vector<char>& in, double candidates, double others, std::vector<Rigid<D>>& poses) {
  of_candidates_ = candidates;
  of_others_ = others;
  in_core_ = core_.has_value();
  for (std::size_t e = 0; e < in.size() && in_core_; ++e) in_core_ = in[e] || core_edge_[e] >= 0;
  if (!in_core_) {
    in_ = in;
    whole_graph_->take(in_, weights());
    whole_graph_->relax(poses, kMostSteps, kEndShare, false);
    poses_ = poses;
    return;
  }
  in_.assign(core_->problem().edges.size(), 1);
  for (std::size_t e = 0; e < in.size(); ++e)
    if (core_edge_[e] >= 0) in_[sz(core_edge_[e])] = in[e];
  relaxCore(poses);
}

template <int D>
void RelaxedSet<D>::relaxCore(std::vector<Rigid<D>>& poses) {
  core_->placeChains(poses);
  core_->relinearise();
  core_graph_->take(in_, weights());
  core_graph_->renew();
  poses_.clear();
  for (std::size_t i = 0; i < core_->problem().poses.size(); ++i)
    poses_.push_back(poses[sz(core_->pose(static_cast<int>(i)))]);
  for (int round = 0; round < kCoreRounds; ++round) {
    core_graph_->relax(poses_, kMostSteps, kEndShare, false);
    const double before = cost();
    poses = core_->expanded(poses_);
    core_->relinearise();
    core_graph_->renew();
    const double most = kEndShare * cost() + kNoSquares;
    if (std::abs(cost() - before) <= most && core_->mismatch(poses_) <= most) break;
  }
}

template <int D>
int RelaxedSet<D>::unknowns() const {
  return graph().unknowns() + static_cast<int>(problem_->poses.size() - problem().poses.size());
}

template <int D>
typename AcceptedGraph<D>::Share RelaxedSet<D>::candidates() {
  std::vector<char> some;
  for (const EdgeRole role : roles()) some.push_back(role == EdgeRole::Candidate);
  return graph().share(poses_, some);
}

template <int D>
double RelaxedSet<D>::logDensity() const {
  double sum = -0.5 * cost() + 0.5 * graph().unknowns() * kN * kLogTwoPi - 0.5 * graph().logDeterminant();
  const auto add = [&](const std::pair<double, int>& determinant, double factor) {
    sum += 0.5 * determinant.first - 0.5 * determinant.second * (kLogTwoPi + std::log(factor));
  };
  for (std::size_t e = 0; e < in_.size(); ++e) {
    if (!in_[e]) continue;
    const int edge = in_core_ ? core_->edge(static_cast<int>(e)) : static_cast<int>(e);
    if (edge < 0) add(logDeterminant<D>(problem().edges[e].information), varianceFactor(e));
    else add({log_information_[sz(edge)], rank_[sz(edge)]}, varianceFactor(e));
  }
  return sum;
}

template <int D>
typename RelaxedSet<D>::Prediction RelaxedSet<D>::predictByOthers(int candidate) const {
  constexpr int kAtOnce = 8;
  const std::size_t e = sz(in_core_ ? core_edge_[sz(candidate)] : candidate);
  const Edge<D>& edge = problem().edges[e];
  const WhitenedEdge<D> white = whitened(edge);
  const WhitenedJacobians<D> at = whitenedJacobians(white, poses_[sz(edge.from)], poses_[sz(edge.to)]);
  std::vector<double> x(sz(graph().unknowns() * kN * kAtOnce), 0.0);
  const auto row = [&](int pose, int a) { return x.data() + (graph().place(pose) * kN + a) * kAtOnce; };
  const std::pair<int, const TangentMatrix<D>*> ends[] = {{edge.from, &at.by_from}, {edge.to, &at.by_to}};
  for (const auto& [pose, J] : ends)
    for (int a = 0; graph().place(pose) >= 0 && a < kN; ++a)
      for (int c = 0; c < kN; ++c) row(pose, a)[c] = (*J)(c, a);
  graph().solveEight(x.data());
  const double factor = varianceFactor(e);
  TangentMatrix<D> left = TangentMatrix<D>::Identity();
  for (const auto& [pose, J] : ends)
    for (int a = 0; graph().place(pose) >= 0 && a < kN; ++a)
      for (int r = 0; r < white.rank; ++r)
        for (int c = 0; c < white.rank; ++c) left(r, c) -= (*J)(r, a) * row(pose, a)[c] / factor;
  const urban_nav_core::SmallCholesky<kN> factored(left);
  if (!factored.succeeded()) return {};
  double log = 0.5 * log_information_[sz(candidate)] - 0.5 * white.rank * (kLogTwoPi + std::log(factor));
  for (int a = 0; a < white.rank; ++a) log += std::log(factored.factor()(a, a));
  const double chi2 = at.error.dot(factored.solve(at.error)) / factor;
  return {log - 0.5 * chi2, chi2};
}

template class RelaxedSet<2>;
template class RelaxedSet<3>;

}  // namespace pose_graph
