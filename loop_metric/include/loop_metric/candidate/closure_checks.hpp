// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop_metric/candidate/shared_keyframes.hpp"
#include "loop_metric/parameters.hpp"
#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// Checks measured closures against each other and discounts shared information: pairwise consistency, then shared
/// clouds, then shared keyframes. Batch version, as used offline: every closure is compared with all others.
void applyChecks(std::vector<urban_nav_core::MetricClosure>& closures, const PlaceData& place_data,
                 const Parameters& parameters);

/// Applies the steps of applyChecks() to closures in order of arrival, as used live: earlier verdicts are final. Not
/// thread-safe.
class SequentialChecks {
 public:
  /// Checks a closure against those accepted earlier. Rejected closures are unchanged.
  void apply(urban_nav_core::MetricClosure& closure, const PlaceData& place_data, const Parameters& parameters);

 private:
  std::vector<urban_nav_core::MetricClosure> accepted_;  // with their information before the discounts
  SharedKeyframeDiscount keyframe_discount_;
};

}  // namespace loop_metric
