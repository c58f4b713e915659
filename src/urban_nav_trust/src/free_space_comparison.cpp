// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/free_space_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;

namespace {

constexpr double kLeastWalls = 50.0;  // surface elements of a place: a share has a resolution of 2 %

/// Returns the probability of at least `least` successes in `trials`, each with the probability `p` in (0, 1).
double binomialTail(std::size_t least, std::size_t trials, double p) {
  const auto n = static_cast<double>(trials);
  double sum = 0.0;
  for (std::size_t i = least; i <= trials; ++i) {
    const auto k = static_cast<double>(i);
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
                    (n - k) * std::log1p(-p));
  }
  return least == 0 ? 1.0 : std::min(1.0, sum);
}

}  // namespace

void testFreeSpace(const std::vector<PlaceVisits>& places, const char* absent_reason, TestResults& results) {
  std::vector<PlaceVisits> measured;
  for (const PlaceVisits& place : places)
    if (place.confirmed + place.contradicted >= kLeastWalls) measured.push_back(place);
  if (measured.empty()) {
    results.absent.push_back(
        {kFreeSpaceTest, places.empty() ? absent_reason : "too few walls where the lasers passed twice"});
    return;
  }
  std::vector<PlaceVisits> through;
  for (const PlaceVisits& place : measured)
    if (place.share() > kSoundShare) through.push_back(place);
  const auto smaller = [](const PlaceVisits& a, const PlaceVisits& b) { return a.share() < b.share(); };
  const PlaceVisits& worst = *std::max_element(measured.begin(), measured.end(), smaller);
  ConsistencyTest test;
  test.name = kFreeSpaceTest;
  test.statistic = static_cast<double>(through.size());
  test.degrees_of_freedom = static_cast<double>(measured.size());
  test.p_value = binomialTail(through.size(), measured.size(), kExceeding);
  test.interval = worst.interval;
  for (const PlaceVisits& place : through.empty() ? measured : through) {
    test.interval.from = std::min(test.interval.from, place.interval.from);
    test.interval.to = std::max(test.interval.to, place.interval.to);
  }
  test.sentence = "At " + std::to_string(through.size()) + " of " + std::to_string(measured.size()) +
                  " places that the lasers passed twice, beams of one visit pass through more than " +
                  formatNumber(100.0 * kSoundShare, 2) + " % of the walls of the other one; the largest share is " +
                  formatNumber(100.0 * worst.share(), 2) + " %.";
  test.remedy =
      "Two visits of a place are not joined correctly: search for a false or a missing closure with `urban_nav why "
      "--jump`, reject it with `urban_nav edge`, or check the lasers' mounting (/tf_static) if all places are "
      "affected.";
  results.tests.push_back(std::move(test));
}

}  // namespace urban_nav_trust
