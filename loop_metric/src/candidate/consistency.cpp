// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/consistency.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "candidate/odometry_gate.hpp"
#include "loop_metric/loop_metric.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace loop_metric {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseWithCovariance;

namespace {

constexpr double kNearPathLength = 30.0;          // m: path length over which the error of odometry is a few
                                                  // centimetres
constexpr double kClosureMetresPerRadian = 10.0;  // for directions without information in a closure
constexpr double kNearTime = 120.0;               // s: maximum time for this path

PoseWithCovariance toMeasured(const MetricClosure& closure) {
  return {closure.measured.T_a_b,
          urban_nav_core::covarianceForDisplay(closure.measured.information, kClosureMetresPerRadian)};
}

/// Returns the root mean square deviation of the loop of two closures; empty if they are not neighbours.
std::optional<double> computeRing(const MetricClosure& i, const MetricClosure& j, const PlaceData& place_data,
                                  const Parameters& parameters) {
  const auto apart = [](const urban_nav_core::PoseRef& x, const urban_nav_core::PoseRef& y) {
    return x.session != y.session || std::abs(urban_nav_core::secondsBetween(x.stamp, y.stamp)) > kNearTime;
  };
  if (apart(i.a, j.a) || apart(i.b, j.b)) return std::nullopt;
  const auto along_a = place_data.between(i.a, j.a), along_b = place_data.between(i.b, j.b);
  if (!along_a || !along_b || along_a->length > kNearPathLength || along_b->length > kNearPathLength)
    return std::nullopt;
  const PoseWithCovariance T_ai_aj = OdometryGate(*along_a, parameters.registration.odometry_scale).T_a_b(),
                           T_bi_bj = OdometryGate(*along_b, parameters.registration.odometry_scale).T_a_b();
  const PoseWithCovariance one = urban_nav_core::compose(toMeasured(i), T_bi_bj),
                           other = urban_nav_core::compose(T_ai_aj, toMeasured(j));
  const auto squares = urban_nav_core::nees(other.pose, {one.pose, one.covariance + other.covariance});
  return squares ? std::optional<double>(std::sqrt(*squares / 6.0)) : std::nullopt;
}

}  // namespace

std::vector<Neighbours> pairwiseConsistencyCheck(std::vector<MetricClosure>& closures, const PlaceData& place_data,
                                                 const Parameters& parameters) {
  std::vector<Neighbours> counts(closures.size());
  std::map<std::pair<std::size_t, std::size_t>, bool> agree;
  for (std::size_t i = 0; i < closures.size(); ++i) {
    if (closures[i].verdict != ClosureVerdict::Accepted) continue;
    for (std::size_t j = i + 1; j < closures.size(); ++j) {
      if (closures[j].verdict != ClosureVerdict::Accepted) continue;
      const auto deviation = computeRing(closures[i], closures[j], place_data, parameters);
      if (!deviation) continue;
      const bool agrees = *deviation <= parameters.gate;
      agree[{i, j}] = agrees;
      for (const std::size_t k : {i, j}) ++(agrees ? counts[k].agreeing : counts[k].contradicting);
    }
  }
  for (;;) {
    std::size_t worst = closures.size();
    for (std::size_t i = 0; i < closures.size(); ++i) {
      if (closures[i].verdict != ClosureVerdict::Accepted || counts[i].contradicting < 2 ||
          counts[i].contradicting <= counts[i].agreeing)
        continue;
      const auto excess = [&](std::size_t k) { return counts[k].contradicting - counts[k].agreeing; };
      if (worst == closures.size() || excess(i) > excess(worst)) worst = i;
    }
    if (worst == closures.size()) return counts;
    MetricClosure& closure = closures[worst];
    closure.verdict = ClosureVerdict::Rejected;
    closure.reason = static_cast<int>(LoopReason::Contradicted);
    closure.reason_name = toString(LoopReason::Contradicted);
    closure.sentence = "contradicted by " + std::to_string(counts[worst].contradicting) +
                       " neighbouring closures, supported by " + std::to_string(counts[worst].agreeing);
    closure.measured.information.setZero();
    for (const auto& [pair, agrees] : agree)
      for (const auto& [one, other] : {pair, std::make_pair(pair.second, pair.first)})
        if (one == worst) --(agrees ? counts[other].agreeing : counts[other].contradicting);
  }
}

}  // namespace loop_metric
