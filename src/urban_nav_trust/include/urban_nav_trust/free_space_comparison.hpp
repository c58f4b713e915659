// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

constexpr const char* kFreeSpaceTest = "free_space";
/// Largest share of walls that beams of another visit pass through, at 99 of 100 pairs of correctly placed clouds:
/// registration.max_free_space_violation.
constexpr double kSoundShare = 0.12;
/// Probability that a correctly placed pair exceeds it.
constexpr double kExceeding = 0.01;

/// Walls near a place that the lasers measured in two visits, each placed by the map.
struct PlaceVisits {
  Interval interval;          ///< from the earlier visit to the later one
  double confirmed = 0.0;     ///< walls of one visit at walls of the other
  double contradicted = 0.0;  ///< walls of one visit that beams of the other pass through
  double share() const { return contradicted / (confirmed + contradicted); }
};

/// Tests that beams of one visit do not pass through walls of another one. `places`: far enough apart that none shares
/// walls with another one. Places with too few walls are ignored. The number of places whose share exceeds kSoundShare
/// is binomial, with at most kExceeding: a single moved object fails no test. Adds a test or an absent one, for the
/// reason `absent_reason` without places.
void testFreeSpace(const std::vector<PlaceVisits>& places, const char* absent_reason, TestResults& results);

}  // namespace urban_nav_trust
