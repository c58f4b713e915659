// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/closure_checks.hpp"

#include <cmath>
#include <utility>

#include "loop_metric/candidate/consistency.hpp"
#include "loop_metric/candidate/shared_clouds.hpp"

namespace loop_metric {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;

namespace {

// Maximum time between compared closures, s, as in consistency.hpp.
constexpr double kMaxNeighbourTime = 120.0;

bool areNeighbours(const PoseRef& one, const PoseRef& other) {
  return one.session == other.session &&
         std::abs(1e-9 * static_cast<double>(one.stamp - other.stamp)) <= kMaxNeighbourTime;
}

}  // namespace

void applyChecks(std::vector<MetricClosure>& closures, const PlaceData& place_data, const Parameters& parameters) {
  pairwiseConsistencyCheck(closures, place_data, parameters);
  discountSharedClouds(closures, place_data, parameters);
  discountSharedKeyframes(closures);
}

void SequentialChecks::apply(MetricClosure& closure, const PlaceData& place_data, const Parameters& parameters) {
  if (closure.verdict != ClosureVerdict::Accepted) return;
  std::vector<MetricClosure> neighbours;
  for (const MetricClosure& earlier : accepted_)
    if (areNeighbours(earlier.a, closure.a) && areNeighbours(earlier.b, closure.b)) neighbours.push_back(earlier);
  neighbours.push_back(closure);
  pairwiseConsistencyCheck(neighbours, place_data, parameters);
  closure = neighbours.back();
  if (closure.verdict != ClosureVerdict::Accepted) return;
  MetricClosure whole = closure;
  whole.evidence.clear();
  discountAgainst(closure, accepted_, place_data, parameters);
  keyframe_discount_.discountAgainst(closure);
  accepted_.push_back(std::move(whole));
}

}  // namespace loop_metric
