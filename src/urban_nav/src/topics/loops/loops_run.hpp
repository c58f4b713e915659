// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/console.hpp"
#include "base/page.hpp"
#include "topics/loops/candidate_measurement.hpp"

namespace urban_nav {

/// Transforms of closure candidates.
struct LoopsRun {
  std::vector<urban_nav_core::MetricClosure> closures;
  std::vector<PagePicture> pictures;  ///< of a few candidates: two keyframes with their matches, or two clouds
  std::size_t candidates = 0, accepted_stereo = 0, accepted_icp = 0, rejected = 0;
  double ms_median = 0.0, ms_p99 = 0.0;  ///< per candidate
  double ms = 0.0;                       ///< of all candidates
  std::vector<std::string> warnings;
  std::vector<urban_nav_core::MetricClosure> measured;  ///< `closures` before they were compared with each other
};

/// Previously measured closures, by their poses.
using MeasuredClosures =
    std::map<std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef>, urban_nav_core::MetricClosure>;

/// Measures the transforms of candidates that are not in `measured` from keyframes and scans of stores, which must be
/// committed, and compares all closures with each other. Uses only the two times and the probability of each candidate.
/// Runs on several threads; the result does not depend on their number.
LoopsRun runLoops(const CandidateMeasurer& measurer, const std::vector<urban_nav_core::MetricClosure>& candidates,
                  const MeasuredClosures& measured, Console& console);

}  // namespace urban_nav
