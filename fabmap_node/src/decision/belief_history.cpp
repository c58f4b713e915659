// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/belief_history.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "recognition/logistic_fit.hpp"

namespace fabmap_node {

using urban_nav_core::StampNs;

namespace {

constexpr double kStaysOnPath = 10.0;   // m, mean distance along which the robot follows an earlier path: twenty
                                        // observations, as LocationFilter, at 2 Hz and 1 m/s
constexpr double kReach = 30.0;         // m; beyond, a verdict counts for less than a twentieth: exp(-30 / 10)
constexpr double kPathTolerance = 5.0;  // m: half the length of a path part that is one place, as ClosureSelector
constexpr double kSmallestProbability = 1e-9;
constexpr StampNs kOneMoment = 500'000'000;  // ns, period of panoramas: verdicts name the nearest frame of odometry

double logOdds(double probability) {
  return std::log(std::max(kSmallestProbability, probability) / std::max(kSmallestProbability, 1.0 - probability));
}

/// Returns the distance along a path from the pose of a verdict to another one, m; nullopt if it is not known, because
/// odometry has the same distance for different moments.
std::optional<double> alongPath(double travelled, StampNs stamp, double travelled_verdict, StampNs stamp_verdict) {
  const double along = std::abs(travelled - travelled_verdict);
  if (along == 0.0 && std::abs(stamp - stamp_verdict) > kOneMoment) return std::nullopt;
  return along;
}

/// Returns the log likelihood ratio of a verdict for a place of a belief; 0 if it does not concern them.
double carriedLogRatio(const VerifiedClosure& closure, const PlaceBelief& belief, const LikelyPlace& place) {
  if (closure.a.session != place.at.session) return 0.0;
  const auto along_a = alongPath(place.travelled, place.at.stamp, closure.travelled_a, closure.a.stamp);
  const StampNs stamp = belief.is_stationary ? closure.b.stamp : belief.at.stamp;
  const auto along_b = alongPath(belief.travelled, stamp, closure.travelled_b, closure.b.stamp);
  if (!along_a || !along_b || std::abs(*along_a - *along_b) > kPathTolerance) return 0.0;
  const double stays = std::exp(-*along_b / kStaysOnPath);
  return std::log(stays * std::exp(logRatio(closure.verdict)) + 1.0 - stays);
}

}  // namespace

PlaceBelief BeliefHistory::add(PlaceBelief belief) {
  PlaceBelief verified = withVerdicts(belief);
  if (!belief.is_stationary) by_appearance_.push_back(std::move(belief));
  return verified;
}

std::vector<PlaceBelief> BeliefHistory::addVerdict(const VerifiedClosure& closure) {
  const std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef> poses{closure.a, closure.b};
  const auto known = closures_.find(poses);
  if (known != closures_.end() && isOfPoseGraph(known->second.verdict) && !isOfPoseGraph(closure.verdict)) return {};
  const auto isBefore = [](const PlaceBelief& belief, double travelled) { return belief.travelled < travelled; };
  const auto begin =
      std::lower_bound(by_appearance_.begin(), by_appearance_.end(), closure.travelled_b - kReach, isBefore);
  const auto end = std::lower_bound(begin, by_appearance_.end(), closure.travelled_b + kReach, isBefore);
  std::vector<PlaceKnowledge> before;
  for (auto one = begin; one != end; ++one) before.push_back(withVerdicts(*one).knowledge);
  const auto [position, is_new] = closures_.insert_or_assign(poses, closure);
  if (is_new) along_path_.emplace(closure.travelled_b, &position->second);
  const auto nearest = std::min_element(begin, end, [&](const PlaceBelief& one, const PlaceBelief& other) {
    return std::abs(one.at.stamp - closure.b.stamp) < std::abs(other.at.stamp - closure.b.stamp);
  });
  std::vector<PlaceBelief> changed;
  for (auto one = begin; one != end; ++one) {
    PlaceBelief belief = withVerdicts(*one);
    if (one == nearest || belief.knowledge != before[static_cast<std::size_t>(one - begin)])
      changed.push_back(std::move(belief));
  }
  return changed;
}

void BeliefHistory::clear() {
  by_appearance_.clear();
  along_path_.clear();
  closures_.clear();
}

PlaceBelief BeliefHistory::withVerdicts(PlaceBelief belief) const {
  if (belief.observation != ObservationStatus::Used || closures_.empty()) return belief;
  bool is_verified = false;
  for (LikelyPlace& place : belief.likeliest) {
    applyVerdicts(belief, place);
    is_verified = is_verified || place.verdict.has_value();
  }
  if (is_verified) decide(parameters_, belief);
  return belief;
}

void BeliefHistory::applyVerdicts(const PlaceBelief& belief, LikelyPlace& place) const {
  double in_favour = 0.0, against = 0.0, strongest = 0.0;
  const auto end = along_path_.upper_bound(belief.travelled + kReach);
  for (auto one = along_path_.lower_bound(belief.travelled - kReach); one != end; ++one) {
    const VerifiedClosure& closure = *one->second;
    const double ratio = carriedLogRatio(closure, belief, place);
    in_favour = std::max(in_favour, ratio);
    against = std::min(against, ratio);
    if (std::abs(ratio) <= strongest) continue;
    strongest = std::abs(ratio);
    place.verdict = closure.verdict;
  }
  if (place.verdict) place.probability = logistic(logOdds(place.probability) + in_favour + against);
}

}  // namespace fabmap_node
