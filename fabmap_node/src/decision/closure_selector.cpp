// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/closure_selector.hpp"

#include <algorithm>
#include <cmath>

namespace fabmap_node {
namespace {

constexpr double kStretch = 5.0;          // m: half the length of a path part within which odometry needs no closures
constexpr double kMostAllowance = 3.0;    // limit of consecutive closures at one position
constexpr double kClearlyLikelier = 2.0;  // ratio of odds to the most probable earlier one, for a further closure of a
                                          // pair

double closureOdds(double probability) { return probability / std::max(1e-12, 1.0 - probability); }

}  // namespace

ClosureSelector::ClosureSelector(const Parameters& parameters)
    : closure_probability_(parameters.closure_probability),
      per_metre_(parameters.closures_per_metre),
      enough_(parameters.enough_closures) {
  beginSession();
}

void ClosureSelector::beginSession() {
  allowance_ = kMostAllowance;
  travelled_ = 0.0;
}

/// After enough closures, a further one must be clearly more probable than all before.
bool ClosureSelector::isWorthOneMore(const Tally& before, double probability) const {
  return before.count < enough_ || closureOdds(probability) >= kClearlyLikelier * before.best_odds;
}

void ClosureSelector::add(double probability, Tally& proposals) {
  proposals.expected += probability;
  proposals.count += 1.0;
  proposals.best_odds = std::max(proposals.best_odds, closureOdds(probability));
}

bool ClosureSelector::select(const PlacePosition& earlier, const PlacePosition& query, double probability) {
  allowance_ = std::min(kMostAllowance, allowance_ + per_metre_ * std::max(0.0, query.travelled - travelled_));
  travelled_ = std::max(travelled_, query.travelled);
  if (probability <= closure_probability_ || allowance_ < 1.0) return false;
  const auto number = [](double travelled) { return static_cast<std::int64_t>(std::floor(travelled / kStretch)); };
  Tally& pair = proposed_[{earlier.session, number(earlier.travelled), query.session, number(query.travelled)}];
  Tally& unlikely = unlikely_[{query.session, number(query.travelled)}];
  const bool is_unlikely = probability < 0.5;
  if (pair.expected >= enough_ || !isWorthOneMore(pair, probability)) return false;
  if (is_unlikely && !isWorthOneMore(unlikely, probability)) return false;
  add(probability, pair);
  if (is_unlikely) add(probability, unlikely);
  allowance_ -= 1.0;
  return true;
}

}  // namespace fabmap_node
