// SPDX-License-Identifier: BSD-3-Clause
#include "solve/accepted_graph.hpp"

#include <algorithm>
#include <cmath>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "linear/ordering.hpp"
#include "marginals/selected_inverse.hpp"
#include "start/chordal_start.hpp"

namespace pose_graph {

namespace {

// Share of the largest diagonal entry, increased until the factorisation succeeds.
constexpr double kSettleDamping = 1e-12, kMostDamping = 1e-3, kGrowth = 100.0;

// Share of edges that may be excluded by zero weight: computing a new order takes as long as a few factorisations.
constexpr double kGone = 0.05;

// Returns the number of block multiplications of a factorisation.
double factorWork(const Symbolic& symbolic) {
  double sum = 0.0;
  for (int s = 0; s < symbolic.size(); ++s) {
    const double columns = symbolic.columns(s), rows = columns + symbolic.rowsBelow(s);
    sum += columns * rows * rows;
  }
  return sum;
}

}  // namespace

template <int D>
void AcceptedGraph<D>::take(const std::vector<char>& in, const std::vector<double>& weights) {
  if (!canKeepPattern(in)) {
    pattern_ = in;
    part_.edges.clear();
    for (std::size_t e = 0; e < in.size(); ++e)
      if (in[e]) part_.edges.push_back(problem_->edges[e]);
    part_.poses = problem_->poses;
    part_.fixed = problem_->fixed;
    equations_ = std::make_unique<NormalEquations<D>>(part_, equations_.get());
    cholesky_ = std::make_unique<BlockCholesky<kN>>(equations_->symbolic());
  }
  in_ = in;
  weights_.clear();
  if (weights.empty() && in_ == pattern_) return;
  for (std::size_t e = 0; e < in.size(); ++e)
    if (pattern_[e]) weights_.push_back(!in[e] ? 0.0 : weights.empty() ? 1.0 : weights[e]);
}

template <int D>
void AcceptedGraph<D>::renew() {
  if (!equations_) return;
  std::size_t at = 0;
  for (std::size_t e = 0; e < pattern_.size(); ++e)
    if (pattern_[e]) part_.edges[at++] = problem_->edges[e];
  equations_->renew(part_, 0);
}

template <int D>
bool AcceptedGraph<D>::canKeepPattern(const std::vector<char>& in) const {
  if (!equations_) return false;
  if (in == pattern_) return true;
  std::size_t gone = 0;
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (in[e] && !pattern_[e]) return false;
    gone += in[e] != pattern_[e];
  }
  if (static_cast<double>(gone) > kGone * static_cast<double>(part_.edges.size())) return false;
  DisjointSets joined(problem_->poses.size());
  joined.joinAll(problem_->fixed);
  int components = joined.size() - std::max(0, static_cast<int>(problem_->fixed.size()) - 1);
  for (std::size_t e = 0; e < in.size(); ++e)
    if (in[e] && joined.join(problem_->edges[e].from, problem_->edges[e].to)) --components;
  return components == equations_->unknowns().components;
}

template <int D>
double AcceptedGraph<D>::work(const std::vector<char>& in, bool soon) const {
  std::vector<char> fixed(problem_->poses.size(), 0);
  for (const int pose : problem_->fixed) fixed[sz(pose)] = 1;
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t e = 0; e < in.size(); ++e) {
    const Edge<D>& edge = problem_->edges[e];
    if (in[e] && !fixed[sz(edge.from)] && !fixed[sz(edge.to)]) pairs.emplace_back(edge.from, edge.to);
  }
  const Adjacency graph = makeAdjacency(static_cast<int>(problem_->poses.size()), pairs);
  return factorWork(analyse(graph, soon ? minimumDegreeOrder(graph) : eliminationOrder(graph)));
}

template <int D>
bool AcceptedGraph<D>::isTooDense() const {
  return factorWork(equations_->symbolic()) > most_work_;
}

template <int D>
void AcceptedGraph<D>::relax(std::vector<Rigid<D>>& poses, int iterations, double share, bool afresh, double most) {
  if (afresh) {
    const auto rotations = chordalRotations(*equations_, poses, weights_);
    auto fresh = rotations ? translationsFor(*equations_, *rotations, poses, weights_) : std::nullopt;
    if (fresh && equations_->cost(Objective::Geodesic, *fresh, weights_) <
                     equations_->cost(Objective::Geodesic, poses, weights_))
      poses = std::move(*fresh);
  }
  SolveOptions options;
  options.iterations = iterations;
  options.tolerance = share;
  if (std::isfinite(most))
    options.progress = [most, last = cost(poses)](int, double now) mutable {
      const bool in_reach = now - (last - now) <= most;
      last = now;
      return in_reach;
    };
  minimise(*equations_, *cholesky_, options, weights_, poses);
}

template <int D>
void AcceptedGraph<D>::settle(std::vector<Rigid<D>>& poses) {
  SolveOptions options;
  options.iterations = kSettleSteps;
  if (minimise(*equations_, *cholesky_, options, weights_, poses).ending != Ending::Iterations) return;
  const auto rotations = chordalRotations(*equations_, poses, weights_);
  auto fresh = rotations ? translationsFor(*equations_, *rotations, poses, weights_) : std::nullopt;
  if (!fresh) return;
  options.iterations = 2 * kSettleSteps;
  minimise(*equations_, *cholesky_, options, weights_, *fresh);
  if (cost(*fresh) < cost(poses)) poses = std::move(*fresh);
}

template <int D>
bool AcceptedGraph<D>::factor(const std::vector<Rigid<D>>& poses) {
  equations_->linearise(Objective::Geodesic, poses, weights_);
  if (cholesky_->factor(equations_->H(), equations_->pattern())) return true;
  double largest = 0.0;
  for (const auto& block : equations_->H().diagonal) largest = std::max(largest, block.diagonal().maxCoeff());
  for (double damping = kSettleDamping; damping < kMostDamping; damping *= kGrowth) {
    for (auto& block : equations_->H().diagonal) block.diagonal().array() += damping * largest;
    if (cholesky_->factor(equations_->H(), equations_->pattern())) return true;
  }
  return false;
}

template <int D>
typename AcceptedGraph<D>::Share AcceptedGraph<D>::share(const std::vector<Rigid<D>>& poses,
                                                         const std::vector<char>& some) {
  std::vector<double> weights;
  weights.reserve(part_.edges.size());
  bool any = false;
  for (std::size_t e = 0; e < in_.size(); ++e) {
    if (!pattern_[e]) continue;
    const double weight = weights_.empty() ? 1.0 : weights_[weights.size()];
    weights.push_back(some[e] ? weight : 0.0);
    any |= weights.back() > 0.0;
  }
  Share made;
  if (!any || unknowns() == 0) return made;
  const BlockMatrix<kN> inverse = selectedInverse(*cholesky_, equations_->pattern());
  made.cost = equations_->linearise(Objective::Geodesic, poses, weights);
  const BlockMatrix<kN>& H = equations_->H();
  for (std::size_t k = 0; k < H.diagonal.size(); ++k)
    made.unknowns += H.diagonal[k].cwiseProduct(inverse.diagonal[k]).sum();
  for (std::size_t k = 0; k < H.lower.size(); ++k)
    made.unknowns += 2.0 * H.lower[k].cwiseProduct(inverse.lower[k]).sum();
  return made;
}

template <int D>
int AcceptedGraph<D>::place(int pose) const {
  const int unknown = equations_->unknowns().of_pose[sz(pose)];
  return unknown < 0 ? -1 : equations_->symbolic().place[sz(unknown)];
}

template class AcceptedGraph<2>;
template class AcceptedGraph<3>;

}  // namespace pose_graph
