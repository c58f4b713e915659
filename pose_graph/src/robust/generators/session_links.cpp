// SPDX-License-Identifier: BSD-3-Clause
#include "robust/generators/session_links.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numeric>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "pose_graph/marginals.hpp"
#include "robust/evidence/chance_density.hpp"
#include "robust/evidence/closure_loops.hpp"
#include "robust/evidence/dead_reckoning.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

constexpr std::size_t kMostPerPair = 400;
constexpr std::size_t kDoubtful = 3;  // limit of links proposed for two parts with too few pairwise consistent closures
// Share of the map's extent and rotation (rad) of a loop error above which a pair is not evaluated.
constexpr double kRoughShare = 0.2, kRoughTurn = 0.5;

struct BetweenClosure {
  int edge = 0, from = 0, to = 0;  // in the order of the parts
};

struct Agreement {
  bool agrees = false;
  double support = 0.0;  // log likelihood ratio of their loop relative to chance; 0 if negative
};

template <int D>
class PairwiseConsistency {
 public:
  PairwiseConsistency(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, const Marginals<D>& marginals,
                      double extent)
      : problem_(problem), poses_(poses), marginals_(marginals), extent_(extent) {}

  /// Tests two closures for consistency. Adds the probability that two random ones are consistent to `chance` if it was
  /// computed.
  Agreement compare(const BetweenClosure& a, const BetweenClosure& b) {
    const Rigid<D> Z_a = measured(a), Z_b = measured(b);
    const Rigid<D> along_to = poses_[sz(a.to)].inverse() * poses_[sz(b.to)];
    const Rigid<D> along_from = poses_[sz(b.from)].inverse() * poses_[sz(a.from)];
    const Rigid<D> back = Z_a * along_to * Z_b.inverse();
    const Rigid<D> remains = back * along_from;
    Tangent<D> d;
    d.template head<D>() = remains.t;
    d.template tail<kRotationSize<D>>() = logRotation(remains.R);
    ++pairs;
    const bool rough =
        remains.t.norm() <= kRoughShare * extent_ && d.template tail<kRotationSize<D>>().norm() <= kRoughTurn;
    // The probability is averaged over all pairs; a sample suffices.
    if (!rough && pairs % 37 != 0) return {};
    const Marginal<D> to = marginals_.between(a.to, b.to), from = marginals_.between(b.from, a.from);
    if (to.knowledge != Knowledge::Full || from.knowledge != Knowledge::Full) return {};
    const Rigid<D> there = Z_a * along_to;
    const TangentMatrix<D> S = spread(Rotation<D>::Identity(), covariance(a, false), remains.t - Z_a.t) +
                               spread(Z_a.R, to.covariance, remains.t - there.t) +
                               spread(there.R, covariance(b, true), remains.t - back.t) +
                               spread(back.R, from.covariance, Eigen::Matrix<double, D, 1>::Zero());
    const urban_nav_core::SmallCholesky<kTangentSize<D>> factored(S);
    if (!factored.succeeded()) return {};
    double log_volume = 0.0;
    for (int i = 0; i < kTangentSize<D>; ++i) log_volume += std::log(factored.factor()(i, i));
    static const double limit = urban_nav_core::chiSquareQuantile(1.0 - Thresholds::kNegligible, kTangentSize<D>);
    const double ball = kTangentSize<D> == 3 ? 4.0 / 3.0 * M_PI : M_PI * M_PI * M_PI / 6.0;
    chance += std::min(1.0, ball * std::pow(limit, 0.5 * kTangentSize<D>) * std::exp(log_volume + log_density_));
    ++counted;
    const double square = d.dot(factored.solve(d));
    if (!rough || !(square <= limit)) return {};
    const double log_true = -0.5 * (square + kTangentSize<D> * kLogTwoPi) - log_volume;
    return {true, std::max(0.0, log_true - log_density_)};
  }

  /// Estimates how often the loop of two unrelated closures closes: with these measurements, between poses drawn from
  /// the two parts.
  void measureChance(const std::vector<BetweenClosure>& closures, const std::vector<int>& froms,
                     const std::vector<int>& tos) {
    std::vector<Rigid<D>> loops;
    for (std::uint64_t k = 0; k < kMostPairs; ++k) {
      const auto pose = [&](const std::vector<int>& part, std::uint64_t number) {
        return poses_[sz(part[drawIndex(6 * k + number, part.size())])];
      };
      const Rigid<D> Z_a = measured(closures[drawIndex(6 * k, closures.size())]);
      const Rigid<D> Z_b = measured(closures[drawIndex(6 * k + 1, closures.size())]);
      const Rigid<D> along_to = pose(tos, 2).inverse() * pose(tos, 3);
      loops.push_back(Z_a * along_to * Z_b.inverse() * (pose(froms, 4).inverse() * pose(froms, 5)));
    }
    log_density_ = PoseSample<D>(std::move(loops), extent_).logDensity({});
  }

  double pairChance() const { return counted > 0 ? chance / static_cast<double>(counted) : 1.0; }

  Rigid<D> measured(const BetweenClosure& closure) const {
    const Edge<D>& edge = problem_.edges[sz(closure.edge)];
    return edge.from == closure.from ? edge.Z : edge.Z.inverse();
  }

 private:
  static TangentMatrix<D> blockTurn(const Rotation<D>& R) {
    TangentMatrix<D> made = TangentMatrix<D>::Identity();
    made.template topLeftCorner<D, D>() = R;
    if constexpr (D == 3) made.template bottomRightCorner<3, 3>() = R;
    return made;
  }
  // Covariance at the end of the loop of a motion (rho, phi) in the axes R, at the lever arm `lever`.
  static TangentMatrix<D> spread(const Rotation<D>& R, const TangentMatrix<D>& covariance,
                                 const Eigen::Matrix<double, D, 1>& lever) {
    TangentMatrix<D> body = TangentMatrix<D>::Identity();
    body.template topRightCorner<D, kRotationSize<D>>() = turned(lever);
    const TangentMatrix<D> all = body * blockTurn(R);
    return all * covariance * all.transpose();
  }
  // Covariance of measured() or its inverse, as (rho, phi) of [Exp(phi) R, t + rho].
  TangentMatrix<D> covariance(const BetweenClosure& closure, bool inverted) const {
    const Edge<D>& edge = problem_.edges[sz(closure.edge)];
    const TangentMatrix<D> turn = blockTurn(edge.Z.R);
    const TangentMatrix<D> forward = turn * boundedCovariance<D>(edge.information, extent_) * turn.transpose();
    if ((edge.from == closure.from) != inverted) return forward;
    TangentMatrix<D> back = -blockTurn(Rotation<D>(edge.Z.R.transpose()));
    back.template topRightCorner<D, kRotationSize<D>>() = edge.Z.R.transpose() * turned(edge.Z.t);
    return back * forward * back.transpose();
  }

  const Problem<D>& problem_;
  const std::vector<Rigid<D>>& poses_;
  const Marginals<D>& marginals_;
  double extent_;
  double log_density_ = 0.0;  // log density of a loop that closes by chance

 public:
  std::size_t pairs = 0, counted = 0;
  double chance = 0.0;
};

struct Agreements {
  std::vector<std::vector<char>> agree;  // of each pair
  std::vector<double> support;           // of each closure, by all others
};

template <int D>
Agreements compareAll(PairwiseConsistency<D>& consistency, const std::vector<BetweenClosure>& closures) {
  const std::size_t size = closures.size();
  Agreements made{std::vector<std::vector<char>>(size, std::vector<char>(size, 0)), std::vector<double>(size, 0.0)};
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = i + 1; j < size; ++j) {
      const Agreement pair = consistency.compare(closures[i], closures[j]);
      made.agree[i][j] = made.agree[j][i] = pair.agrees;
      made.support[i] += pair.support;
      made.support[j] += pair.support;
    }
  return made;
}

// Returns at most kDoubtful closures, the best supported first.
std::vector<std::size_t> bestSupported(const std::vector<double>& support) {
  std::vector<std::size_t> order(support.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return support[a] > support[b]; });
  order.resize(std::min(kDoubtful, order.size()));
  return order;
}

// Returns the largest pairwise consistent set, grown greedily from each member in order of degree.
std::vector<std::size_t> largestClique(const std::vector<std::vector<char>>& agree) {
  const std::size_t n = agree.size();
  std::vector<std::size_t> degree(n, 0), order(n), best;
  for (std::size_t i = 0; i < n; ++i)
    degree[i] = static_cast<std::size_t>(std::count(agree[i].begin(), agree[i].end(), 1));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return degree[a] > degree[b]; });
  for (const std::size_t seed : order) {
    if (degree[seed] + 1 <= best.size()) break;
    std::vector<std::size_t> set{seed};
    for (const std::size_t next : order)
      if (next != seed && std::all_of(set.begin(), set.end(), [&](std::size_t i) { return agree[next][i] != 0; }))
        set.push_back(next);
    if (set.size() > best.size()) best = set;
  }
  return best;
}

// Two closures of one row are consistent whether true or false.
bool areOneRow(const BetweenClosure& a, const BetweenClosure& b) {
  return std::abs(a.from - b.from) <= kRowReach && std::abs(a.to - b.to) <= kRowReach;
}

}  // namespace

template <int D>
std::vector<int> sessionParts(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  DisjointSets parts(problem.poses.size());
  parts.joinAll(problem.fixed);
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] == EdgeRole::Candidate || problem.edges[e].information.isZero(0.0)) continue;
    parts.join(problem.edges[e].from, problem.edges[e].to);
  }
  std::vector<int> part(problem.poses.size());
  for (int i = 0; i < parts.size(); ++i) part[sz(i)] = parts.root(i);
  return part;
}

template <int D>
SessionLinks linkSessions(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                          const std::vector<Rigid<D>>& poses) {
  SessionLinks made;
  DisjointSets sets(problem.poses.size());
  sets.joinAll(problem.fixed);
  std::vector<double> weights(in.begin(), in.end());
  for (std::size_t e = 0; e < in.size(); ++e)
    if (in[e]) sets.join(problem.edges[e].from, problem.edges[e].to);
  std::map<std::pair<int, int>, std::vector<BetweenClosure>> between;
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (roles[e] != EdgeRole::Candidate || in[e]) continue;
    const Edge<D>& edge = problem.edges[e];
    const int a = sets.root(edge.from), b = sets.root(edge.to);
    if (a == b) continue;
    between[{std::min(a, b), std::max(a, b)}].push_back(
        {static_cast<int>(e), a < b ? edge.from : edge.to, a < b ? edge.to : edge.from});
  }
  if (between.empty()) return made;
  std::vector<int> part(problem.poses.size());
  for (int i = 0; i < sets.size(); ++i) part[sz(i)] = sets.root(i);
  const Marginals<D> marginals(problem, poses, weights);
  const DeadReckoning<D> reckoning(problem, roles);
  std::vector<std::pair<std::size_t, std::pair<int, int>>> by_size;
  for (const auto& [parts, closures] : between) by_size.emplace_back(closures.size(), parts);
  std::stable_sort(by_size.begin(), by_size.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [all, parts] : by_size) {
    if (sets.areJoined(parts.first, parts.second) || all < Thresholds::kLeastAgreeing) continue;
    std::vector<BetweenClosure> closures;
    const std::size_t every = 1 + all / kMostPerPair;
    for (std::size_t i = 0; i < all; i += every) closures.push_back(between[parts][i]);
    const std::size_t size = closures.size();
    PairwiseConsistency<D> consistency(problem, poses, marginals, reckoning.extent);
    std::vector<int> froms, tos;
    for (int i = 0; i < sets.size(); ++i) {
      if (part[sz(i)] == parts.first) froms.push_back(i);
      if (part[sz(i)] == parts.second) tos.push_back(i);
    }
    consistency.measureChance(closures, froms, tos);
    const Agreements found = compareAll(consistency, closures);
    const std::vector<std::size_t> set = largestClique(found.agree);
    const double n = static_cast<double>(size), k = static_cast<double>(set.size());
    const double log_chance = std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                              (k - 1.0) * std::log(consistency.pairChance());
    if (set.size() < Thresholds::kLeastAgreeing) continue;
    if (set.size() == Thresholds::kLeastAgreeing && areOneRow(closures[set[0]], closures[set[1]])) continue;
    if (log_chance > std::log(Thresholds::kChance)) {
      for (const std::size_t i : bestSupported(found.support)) made.doubtful.push_back(closures[i].edge);
      continue;
    }
    made.agreed.push_back(closures[set.front()].edge);
    sets.join(parts.first, parts.second);
  }
  return made;
}

template std::vector<int> sessionParts<2>(const Problem<2>&, const std::vector<EdgeRole>&);
template std::vector<int> sessionParts<3>(const Problem<3>&, const std::vector<EdgeRole>&);
template SessionLinks linkSessions<2>(const Problem<2>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                      const std::vector<Rigid<2>>&);
template SessionLinks linkSessions<3>(const Problem<3>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                      const std::vector<Rigid<3>>&);

}  // namespace pose_graph
