// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// The two views that an accepted closure by stereo rests on, the earlier one first, as its evidence has them; empty for any other closure, and for one without
/// evidence.
struct ViewPair {
  urban_nav_core::PoseRef first, second;
};
bool operator<(const ViewPair& one, const ViewPair& other);
std::optional<ViewPair> viewsOf(const urban_nav_core::MetricClosure& closure);

/// Candidates half a second apart, or of a robot that stands, are measured by the same two views: that is one measurement, carried along odometry to several moments.
/// What it knows is shared out among them: the information of each is divided by how many rest on the same views. DataError where evidence is none.
void shareViews(std::vector<urban_nav_core::MetricClosure>& closures);

/// The same where closures are judged one after another and none can be taken back: the first one of two views tells all that they know, and those after it a
/// thousandth, which shows that they agree and weighs nothing.
class ToldViews {
 public:
  void keepWhatIsNew(urban_nav_core::MetricClosure& closure);

 private:
  std::set<ViewPair> told_;
};

}  // namespace loop_metric
