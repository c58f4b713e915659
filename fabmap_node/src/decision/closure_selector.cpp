// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/closure_selector.hpp"

#include <algorithm>
#include <cmath>

namespace fabmap_node {
namespace {

constexpr double stretch = 5.0;           // m: half a stretch over which odometry needs no help
constexpr double most_allowance = 3.0;    // closures that may follow each other at one position
constexpr double clearly_likelier = 2.0;  // ratio of odds to the likeliest of those before, for one more of a pair

double closureOdds(double probability) { return probability / std::max(1e-12, 1.0 - probability); }

}  // namespace

ClosureSelector::ClosureSelector(const Parameters& parameters)
    : closure_probability_(parameters.closure_probability),
      per_metre_(parameters.closures_per_metre),
      enough_(parameters.enough_closures) {
  beginSession();
}

void ClosureSelector::beginSession() {
  allowance_ = most_allowance;
  travelled_ = 0.0;
}

bool ClosureSelector::select(const PlacePosition& earlier, const PlacePosition& query, double probability) {
  allowance_ = std::min(most_allowance, allowance_ + per_metre_ * std::max(0.0, query.travelled - travelled_));
  travelled_ = std::max(travelled_, query.travelled);
  if (probability <= closure_probability_ || allowance_ < 1.0) return false;
  const auto number = [](double travelled) { return static_cast<std::int64_t>(std::floor(travelled / stretch)); };
  Proposed& before = proposed_[{earlier.session, number(earlier.travelled), query.session, number(query.travelled)}];
  if (before.expected >= enough_) return false;
  if (before.count >= enough_ && closureOdds(probability) < clearly_likelier * before.best_odds) return false;
  before.expected += probability;
  before.count += 1.0;
  before.best_odds = std::max(before.best_odds, closureOdds(probability));
  allowance_ -= 1.0;
  return true;
}

}  // namespace fabmap_node
