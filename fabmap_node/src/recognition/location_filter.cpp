// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/location_filter.hpp"

#include <algorithm>
#include <cmath>

namespace fabmap_node {
namespace {

constexpr std::size_t kPlacesAround = 4;  // on each side: up to four times the speed of the first visit
constexpr double kChange = 0.05;  // probability of a change from known to new, new to known, or between places: every
                                  // twenty observations
constexpr double kPlacesElsewhere = 10.0;  // number of places that share the probability elsewhere: as many as are
                                           // compared
constexpr double kLargestLogRatio = 6.0;   // limit for one observation: that of a calibration

constexpr std::size_t kSequenceLength = 20;  // as many similar consecutive observations count as one in a calibration
constexpr double kOnPath = 1.0;              // places, tolerance of the path at constant speed
// In tenths of a place per observation: paths of adjacent speeds are at most twice the tolerance apart at their ends.
constexpr int kSlowest = 5, kFastest = 20;
constexpr double kSpeedStep = 0.1;
static_assert(kSpeedStep * kSequenceLength <= 2.0 * kOnPath);

bool isAround(std::size_t session_a, std::size_t a, std::size_t session_b, std::size_t b) {
  return session_a == session_b && (a > b ? a - b : b - a) <= kPlacesAround;
}

/// Returns the largest positive margin of the places within kOnPath of `expected`; zero without one.
double largestMarginNear(const std::vector<LocationHypothesis>& observation, std::size_t session, double expected) {
  double largest = 0.0;
  for (const LocationHypothesis& one : observation)
    if (one.session == session && std::abs(static_cast<double>(one.place) - expected) <= kOnPath)
      largest = std::max(largest, one.margin);
  return largest;
}

}  // namespace

double LocationFilter::priorLogOdds(std::size_t session, std::size_t place) const {
  if (locations_.empty() && p_new_ == 0.5) return 0.0;
  double around = 0.0;
  for (const Location& location : locations_)
    if (isAround(location.session, location.place, session, place)) around += location.probability;
  const double known = 1.0 - p_new_;
  const double elsewhere = kChange * (p_new_ + std::max(0.0, known - around)) / kPlacesElsewhere;
  const double here = (1.0 - kChange) * std::min(1.0, around) + elsewhere;
  const double at_new = (1.0 - kChange) * p_new_ + kChange * known;
  return std::log(here * kPlacesElsewhere / at_new);
}

double LocationFilter::pathMargin(std::size_t session, std::size_t place) const {
  double largest = 0.0;
  for (int tenths = kSlowest; tenths <= kFastest; ++tenths)
    for (const double speed : {kSpeedStep * tenths, -kSpeedStep * tenths}) {
      double sum = 0.0, expected = static_cast<double>(place);
      for (const std::vector<LocationHypothesis>& observation : recent_) {
        expected -= speed;
        sum += largestMarginNear(observation, session, expected);
      }
      largest = std::max(largest, sum);
    }
  return largest / static_cast<double>(kSequenceLength);
}

void LocationFilter::update(const std::vector<LocationHypothesis>& hypotheses) {
  if (hypotheses.empty()) return;
  recent_.push_front(hypotheses);
  if (recent_.size() > kSequenceLength) recent_.pop_back();
  std::vector<Location> ranked;
  for (const LocationHypothesis& hypothesis : hypotheses) {
    const double ratio = std::clamp(hypothesis.log_ratio, -kLargestLogRatio, kLargestLogRatio);
    ranked.push_back(
        {hypothesis.session, hypothesis.place, std::exp(ratio + priorLogOdds(hypothesis.session, hypothesis.place))});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Location& a, const Location& b) { return a.probability > b.probability; });
  std::vector<Location> apart;
  double sum = 1.0;  // NEW
  for (const Location& location : ranked) {
    if (std::any_of(apart.begin(), apart.end(), [&location](const Location& other) {
          return isAround(location.session, location.place, other.session, other.place);
        }))
      continue;
    apart.push_back(location);
    sum += location.probability;
  }
  for (Location& location : apart) location.probability /= sum;
  locations_ = std::move(apart);
  p_new_ = 1.0 / sum;
}

std::size_t likeliestLocation(const LocationFilter& filter, const std::vector<LocationHypothesis>& hypotheses) {
  std::size_t best = 0;
  double best_value = 0.0;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    const double value = hypotheses[i].log_ratio + filter.priorLogOdds(hypotheses[i].session, hypotheses[i].place);
    if (i > 0 && value <= best_value) continue;
    best = i;
    best_value = value;
  }
  return best;
}

}  // namespace fabmap_node
