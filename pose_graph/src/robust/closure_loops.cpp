// SPDX-License-Identifier: BSD-3-Clause
#include "robust/closure_loops.hpp"

#include <algorithm>
#include <cmath>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace pose_graph {

namespace {

const double kLogTwoPi = std::log(2.0 * 3.14159265358979323846);

}  // namespace

template <int D>
typename ClosureLoops<D>::Closure ClosureLoops<D>::toClosure(const Problem<D>& problem, int e, double extent) {
  const Edge<D>& edge = problem.edges[sz(e)];
  const TangentMatrix<D> child = boundedCovariance<D>(edge.information, extent);
  if (edge.from <= edge.to) {
    const TangentMatrix<D> turn = adjoint<D>(edge.Z);
    return {e, edge.from, edge.to, edge.Z, turn * child * turn.transpose()};
  }
  return {e, edge.to, edge.from, edge.Z.inverse(), child};
}

template <int D>
ClosureLoops<D>::ClosureLoops(const Problem<D>& problem, const std::vector<int>& candidates,
                              const DeadReckoning<D>& chains)
    : chains_(&chains) {
  closures_.reserve(candidates.size());
  for (int e : candidates) closures_.push_back(toClosure(problem, e, chains.extent));
  std::sort(closures_.begin(), closures_.end(), [&](const Closure& a, const Closure& b) {
    const auto on_a = closureChains(a), on_b = closureChains(b);
    return on_a != on_b ? on_a < on_b : a.from != b.from ? a.from < b.from : a.edge < b.edge;
  });
}

template <int D>
ClosureLoop ClosureLoops<D>::loop(std::size_t first, std::size_t second) const {
  constexpr int kN = kTangentSize<D>;
  const Closure &a = closures_[first], &b = closures_[second];
  const DeadReckoning<D>& chains = *chains_;
  const Rigid<D> to_b = a.Z * (chains.pose[sz(a.to)].inverse() * chains.pose[sz(b.to)]);
  const Rigid<D> back = to_b * b.Z.inverse();
  const Rigid<D> remains = back * (chains.pose[sz(b.from)].inverse() * chains.pose[sz(a.from)]);
  Tangent<D> d;
  d.template head<D>() = remains.t;
  d.template tail<kRotationSize<D>>() = logRotation(remains.R);
  const TangentMatrix<D> over_a = adjoint<D>(a.Z), over_b = adjoint<D>(back);
  const TangentMatrix<D> S = a.covariance + over_a * chains.covariance(a.to, b.to) * over_a.transpose() +
                             over_b * (b.covariance + chains.covariance(b.from, a.from)) * over_b.transpose();
  const urban_nav_core::SmallCholesky<kN> factored(S);
  const double span = chains.of_pose[sz(a.from)] == chains.of_pose[sz(a.to)]
                          ? std::min(chains.extent, std::abs(chains.way[sz(a.to)] - chains.way[sz(a.from)]))
                          : chains.extent;
  ClosureLoop made;
  made.chi2 = d.dot(factored.solve(d));
  made.log_true = -0.5 * kN * kLogTwoPi;
  for (int i = 0; i < kN; ++i) made.log_true -= std::log(factored.factor()(i, i));
  made.log_false = -kRotationSize<D> * kLogTwoPi - D * std::log(2.0 * std::max(span, 1e-3));
  return made;
}

template class ClosureLoops<2>;
template class ClosureLoops<3>;

}  // namespace pose_graph
