// SPDX-License-Identifier: BSD-3-Clause
#include "robust/agreement.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "manifold/rotation.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

constexpr int kNear =
    10;  // poses: about the length of a visit to a place; beyond, odometry's own error hides what a pair says
constexpr int kPartners = 20;  // compared with each closure at most: one that agrees is enough
const double kLogTwoPi = std::log(2.0 * 3.14159265358979323846);

// A closure with its ends in the order of their numbers.
template <int D>
struct Ordered {
  int edge = 0, from = 0, to = 0;
  Rigid<D> Z;
  TangentMatrix<D> covariance;  // in the frame of `from`
};

template <int D>
Ordered<D> orderedOf(const Problem<D>& problem, int e, double extent) {
  const Edge<D>& edge = problem.edges[sz(e)];
  const TangentMatrix<D> child = boundedCovariance<D>(edge.information, extent);
  if (edge.from <= edge.to) {
    const TangentMatrix<D> turn = adjoint<D>(edge.Z);
    return {e, edge.from, edge.to, edge.Z, turn * child * turn.transpose()};
  }
  return {e, edge.to, edge.from, edge.Z.inverse(), child};
}

template <int D>
bool agree(const Ordered<D>& a, const Ordered<D>& b, const Chains<D>& chains, const Thresholds& thresholds) {
  constexpr int N = tangent_size<D>;
  const Rigid<D> to_b = a.Z * (chains.pose[sz(a.to)].inverse() * chains.pose[sz(b.to)]);
  const Rigid<D> back = to_b * b.Z.inverse();
  const Rigid<D> loop = back * (chains.pose[sz(b.from)].inverse() * chains.pose[sz(a.from)]);
  Tangent<D> d;
  d.template head<D>() = loop.t;
  d.template tail<rotation_size<D>>() = logRotation(loop.R);
  const TangentMatrix<D> over_a = adjoint<D>(a.Z), over_b = adjoint<D>(back);
  const TangentMatrix<D> S = a.covariance + over_a * chains.covariance(a.to, b.to) * over_a.transpose() +
                             over_b * (b.covariance + chains.covariance(b.from, a.from)) * over_b.transpose();
  const Eigen::LLT<TangentMatrix<D>> llt(S);
  const double chi2 = d.dot(llt.solve(d));
  if (!(chi2 <= thresholds.limit[N])) return false;
  const double span = chains.of_pose[sz(a.from)] == chains.of_pose[sz(a.to)]
                          ? std::min(chains.extent, std::abs(chains.way[sz(a.to)] - chains.way[sz(a.from)]))
                          : chains.extent;
  double evidence = -0.5 * chi2 - 0.5 * N * kLogTwoPi + rotation_size<D> * kLogTwoPi;
  for (int i = 0; i < N; ++i) evidence -= std::log(llt.matrixLLT()(i, i));
  evidence += D * std::log(2.0 * std::max(span, 1e-3));
  return evidence >= Thresholds::kEvidence;
}

int rootOf(std::vector<int>& above, int i) {
  while (above[sz(i)] != i) i = above[sz(i)] = above[sz(above[sz(i)])];
  return i;
}

}  // namespace

Thresholds::Thresholds(std::size_t candidates, int largest_dof) {
  // With few candidates the tests stay as strict as with ten.
  const double each = kFalseAlarms / static_cast<double>(std::max<std::size_t>(10, candidates));
  early_evidence = std::max(kEvidence, -std::log(each));
  limit.assign(1, 0.0);
  for (int dof = 1; dof <= largest_dof; ++dof) limit.push_back(urban_nav_core::chiSquareQuantile(1.0 - each, dof));
}

template <int D>
std::vector<int> agreeingGroups(const Problem<D>& problem, const std::vector<int>& candidates, const Chains<D>& chains,
                                const Thresholds& thresholds) {
  std::vector<Ordered<D>> ordered;
  ordered.reserve(candidates.size());
  for (int e : candidates) ordered.push_back(orderedOf(problem, e, chains.extent));
  const auto chainsOf = [&](const Ordered<D>& o) {
    return std::make_pair(chains.of_pose[sz(o.from)], chains.of_pose[sz(o.to)]);
  };
  std::sort(ordered.begin(), ordered.end(), [&](const Ordered<D>& a, const Ordered<D>& b) {
    const auto ca = chainsOf(a), cb = chainsOf(b);
    return ca != cb ? ca < cb : a.from != b.from ? a.from < b.from : a.edge < b.edge;
  });
  std::vector<int> above(problem.edges.size());
  std::iota(above.begin(), above.end(), 0);
  for (std::size_t a = 0; a < ordered.size(); ++a) {
    const auto on = chainsOf(ordered[a]);
    const bool between = on.first != on.second;
    int partners = 0;
    for (std::size_t b = a + 1; b < ordered.size() && partners < kPartners; ++b) {
      if (chainsOf(ordered[b]) != on || (!between && ordered[b].from > ordered[a].from + kNear)) break;
      if (!between && std::abs(ordered[b].to - ordered[a].to) > kNear) continue;
      ++partners;
      const int i = rootOf(above, ordered[a].edge), j = rootOf(above, ordered[b].edge);
      if (i != j && agree(ordered[a], ordered[b], chains, thresholds)) above[sz(std::max(i, j))] = std::min(i, j);
    }
  }
  std::vector<int> group(problem.edges.size(), -1);
  for (int e : candidates) group[sz(e)] = rootOf(above, e);
  return group;
}

template std::vector<int> agreeingGroups<2>(const Problem<2>&, const std::vector<int>&, const Chains<2>&,
                                            const Thresholds&);
template std::vector<int> agreeingGroups<3>(const Problem<3>&, const std::vector<int>&, const Chains<3>&,
                                            const Thresholds&);

}  // namespace pose_graph
