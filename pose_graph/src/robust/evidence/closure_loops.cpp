// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/closure_loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

template <int D>
typename ClosureLoops<D>::Closure ClosureLoops<D>::toClosure(const Problem<D>& problem, int e, double extent) {
  const Edge<D>& edge = problem.edges[sz(e)];
  const TangentMatrix<D> child = boundedCovariance<D>(edge.information, extent);
  const double metres = child.diagonal().template head<D>().sum(), radians = child.trace() - metres;
  if (edge.from <= edge.to) {
    const TangentMatrix<D> turn = adjoint<D>(edge.Z);
    return {e, edge.from, edge.to, edge.Z, turn * child * turn.transpose(), {metres, radians}};
  }
  return {e, edge.to, edge.from, edge.Z.inverse(), child, {metres, radians}};
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
  double metres = 0.0, radians = 0.0;
  for (std::size_t i = 0; i < chains.Q.size(); ++i) {
    const TangentMatrix<D> back = adjoint<D>(chains.pose[i].inverse());
    const TangentMatrix<D> Q = back * chains.Q[i] * back.transpose();
    const double translation = Q.diagonal().template head<D>().sum();
    metres += translation;
    radians += Q.trace() - translation;
    steps_[0].push_back(metres);
    steps_[1].push_back(radians);
  }
}

template <int D>
std::size_t ClosureLoops<D>::nextInRow(std::size_t a) const {
  const Closure& first = closures_[a];
  for (std::size_t b = a + 1; b < closures_.size() && closureChains(closures_[b]) == closureChains(first); ++b) {
    const Closure& other = closures_[b];
    double left[2];  // variances of both closures minus those of odometry
    for (int kind = 0; kind < 2; ++kind)
      left[kind] = first.variances[kind] + other.variances[kind] - stepVariance(first.from, other.from, kind);
    const bool near = other.from - first.from <= kRowReach, known = left[0] >= 0.0 && left[1] >= 0.0;
    if (!near && !known) break;
    if (near && std::abs(other.to - first.to) <= kRowReach) return b;
    if (known && stepVariance(first.to, other.to, 0) <= left[0] && stepVariance(first.to, other.to, 1) <= left[1])
      return b;
  }
  return closures_.size();
}

template <int D>
double ClosureLoops<D>::metresBetween(std::size_t a, std::size_t b) const {
  const std::vector<double>& driven = chains_->way;
  const auto metres = [&](int from, int to) { return std::abs(driven[sz(to)] - driven[sz(from)]); };
  return std::max(metres(closures_[a].from, closures_[b].from), metres(closures_[a].to, closures_[b].to));
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
  made.log_false = -kRotationSize<D> * kLogTwoPi - D * std::log(2.0 * std::max(span, kLeastExtent));
  return made;
}

namespace {

constexpr std::size_t kLoops = 500;  // evaluated loops: the factor is then accurate to a few percent
constexpr int kScaleSteps = 20;

// Mixture of loops of true closures, of false closures that nearly agree, and of other false ones.
struct Mixture {
  double factor = 1.0, loose = kLooseFactor;  // variance factors of the first two kinds
  double shares[3] = {0.5, 0.25, 0.25};
  double true_loops = 0.0;
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

// `rows`: whether the mixture includes false closures that nearly agree.
Mixture mixtureFrom(const std::vector<ClosureLoop>& loops, int dof, double factor, bool rows) {
  Mixture made;
  if (!rows) made.shares[1] = 0.0;
  made.factor = factor;
  made.loose = kLooseFactor * factor;
  for (int i = 0; i < kScaleSteps; ++i) {
    // Prior: one loop of unit variance.
    double squares[2] = {1.0 * dof, dof * made.loose}, numbers[2] = {1.0 * dof, 1.0 * dof};
    double sum[3] = {0.0, 0.0, 0.0};
    made.log_likelihood = 0.0;
    for (const ClosureLoop& loop : loops) {
      const double factors[2] = {made.factor, made.loose};
      double logs[3], most = logs[2] = std::log(made.shares[2]) + loop.log_false;
      for (int k = 0; k < 2; ++k) {
        logs[k] =
            std::log(made.shares[k]) + loop.log_true - 0.5 * dof * std::log(factors[k]) - 0.5 * loop.chi2 / factors[k];
        most = std::max(most, logs[k]);
      }
      double total = 0.0;
      for (double& log : logs) total += log = std::exp(log - most);
      made.log_likelihood += most + std::log(total);
      for (int k = 0; k < 3; ++k) sum[k] += logs[k] / total;
      for (int k = 0; k < 2; ++k) {
        squares[k] += logs[k] / total * loop.chi2;
        numbers[k] += logs[k] / total * dof;
      }
    }
    made.true_loops = sum[0];
    made.factor = squares[0] / numbers[0];
    made.loose = std::max(squares[1] / numbers[1], kLooseFactor * made.factor);
    for (int k = 0; k < 3; ++k)
      if (made.shares[k] > 0.0)
        made.shares[k] = std::max(Thresholds::kNegligible, sum[k] / static_cast<double>(loops.size()));
  }
  return made;
}

// Fits the mixture from three initial factors and returns the best fit, as the result depends on the initial value: the
// first quartile, the median, and the stated variances.
Mixture likeliest(const std::vector<ClosureLoop>& loops, int dof, bool rows) {
  std::vector<double> chi2;
  for (const ClosureLoop& loop : loops) chi2.push_back(loop.chi2);
  std::sort(chi2.begin(), chi2.end());
  Mixture best;
  for (const double begin : {chi2[chi2.size() / 4] / dof, chi2[chi2.size() / 2] / dof, 1.0}) {
    const Mixture one = mixtureFrom(loops, dof, std::max(begin, 1e-12), rows);
    if (one.log_likelihood > best.log_likelihood) best = one;
  }
  return best;
}

}  // namespace

template <int D>
InformationScale informationScale(const ClosureLoops<D>& closures) {
  constexpr int kDof = kTangentSize<D>;
  std::vector<ClosureLoop> loops;
  const std::size_t step = 1 + closures.size() / kLoops;
  for (std::size_t a = 0; a < closures.size(); a += step)
    closures.partners(a, 1, [&](std::size_t b) {
      const ClosureLoop loop = closures.loop(a, b);
      if (std::isfinite(loop.chi2) && std::isfinite(loop.log_true)) loops.push_back(loop);
    });
  if (loops.empty()) return {};
  const Mixture plain = likeliest(loops, kDof, false);
  InformationScale made{plain.factor, plain.true_loops, plain.shares[0]};
  // If false closures that nearly agree outnumber true ones, their variance fits better than that of the true ones.
  // Hence the information counts as overconfident only if the mixture that includes such closures shows it too.
  if (made.factor > 1.0)
    made.factor = plain.true_loops < kTellingLoops ? 1.0 : std::max(1.0, likeliest(loops, kDof, true).factor);
  return made;
}

template <int D>
std::vector<int> closureRows(const ClosureLoops<D>& closures, std::size_t edges) {
  DisjointSets rows(closures.size());
  std::vector<std::size_t> first(closures.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (std::size_t a = 0; a < closures.size(); ++a) {
    const std::size_t b = closures.nextInRow(a);
    if (b == closures.size() || closures.metresBetween(first[a], b) > closures.extent()) continue;
    first[b] = std::min(first[a], first[b]);
    rows.join(static_cast<int>(a), static_cast<int>(b));
  }
  std::vector<int> row(edges, -1);
  for (std::size_t i = 0; i < closures.size(); ++i)
    row[sz(closures.edge(i))] = closures.edge(sz(rows.root(static_cast<int>(i))));
  return row;
}

namespace {

constexpr int kPartners = 20;  // limit of comparisons per closure: one consistent partner suffices

template <int D>
bool agree(const ClosureLoop& loop, double variance, const Thresholds& thresholds) {
  constexpr int kN = kTangentSize<D>;
  if (!(loop.chi2 <= variance * thresholds.limit[kN])) return false;
  const double log_true = loop.log_true - 0.5 * kN * std::log(variance) - 0.5 * loop.chi2 / variance;
  return log_true - loop.log_false >= Thresholds::kEvidence;
}

}  // namespace

Thresholds::Thresholds(std::size_t candidates, int largest_dof) {
  // With fewer than ten candidates the tests are as strict as with ten.
  const double each = kFalseAlarms / static_cast<double>(std::max<std::size_t>(10, candidates));
  early_evidence = std::max(kEvidence, -std::log(each));
  limit.assign(1, 0.0);
  for (int dof = 1; dof <= largest_dof; ++dof) limit.push_back(urban_nav_core::chiSquareQuantile(1.0 - each, dof));
}

template <int D>
std::vector<int> consistentGroups(std::size_t edges, const ClosureLoops<D>& closures, double variance,
                                  const Thresholds& thresholds) {
  DisjointSets joined(edges);
  for (std::size_t a = 0; a < closures.size(); ++a)
    closures.partners(a, kPartners, [&](std::size_t b) {
      if (!joined.areJoined(closures.edge(a), closures.edge(b)) && agree<D>(closures.loop(a, b), variance, thresholds))
        joined.join(closures.edge(a), closures.edge(b));
    });
  std::vector<int> group(edges, -1);
  for (std::size_t a = 0; a < closures.size(); ++a) group[sz(closures.edge(a))] = joined.root(closures.edge(a));
  return group;
}

template class ClosureLoops<2>;
template class ClosureLoops<3>;
template std::vector<int> closureRows<2>(const ClosureLoops<2>&, std::size_t);
template std::vector<int> closureRows<3>(const ClosureLoops<3>&, std::size_t);
template InformationScale informationScale<2>(const ClosureLoops<2>&);
template InformationScale informationScale<3>(const ClosureLoops<3>&);
template std::vector<int> consistentGroups<2>(std::size_t, const ClosureLoops<2>&, double, const Thresholds&);
template std::vector<int> consistentGroups<3>(std::size_t, const ClosureLoops<3>&, double, const Thresholds&);

}  // namespace pose_graph
