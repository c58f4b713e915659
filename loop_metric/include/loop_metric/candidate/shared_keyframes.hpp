// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// The two keyframes of a closure accepted by stereo, the earlier one first.
struct SharedKeyframes {
  urban_nav_core::PoseRef first, second;
};
bool operator<(const SharedKeyframes& one, const SharedKeyframes& other);
/// Returns the two keyframes of a closure, from its evidence; nullopt if the closure is not accepted by stereo or has
/// no evidence.
std::optional<SharedKeyframes> findKeyframes(const urban_nav_core::MetricClosure& closure);

/// Divides the information of closures measured by the same two keyframes among them: candidates half a second apart,
/// or of a standing robot, are one measurement transferred along odometry to several poses. Throws DataError if
/// evidence is damaged.
void discountSharedKeyframes(std::vector<urban_nav_core::MetricClosure>& closures);

/// Discounts closures in order of arrival, whose verdicts are final: the first one of two keyframes keeps its
/// information, later ones get a thousandth of it. Not thread-safe.
class SharedKeyframeDiscount {
 public:
  void discountAgainst(urban_nav_core::MetricClosure& closure);

 private:
  std::set<SharedKeyframes> known_;
};

}  // namespace loop_metric
