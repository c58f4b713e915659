// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "loop_metric/loop_metric.hpp"

namespace loop_metric {

/// What a verdict rests on, small enough to be kept for every candidate: what `urban_nav why` shows.
struct Evidence {
  struct Try {
    std::string method;  ///< "stereo", "icp"
    urban_nav_core::PoseRef view_a,
        view_b;  ///< of stereo: whose keyframes were matched; of icp: the moments of the clouds
    std::string verdict, reason, sentence;
    std::vector<ClosureTest> tests;
    std::vector<MatchedPixels> pixels;                 ///< of stereo, at most a hundred, spread over all
    std::optional<urban_nav_core::Pose> guess, T_a_b;  ///< of icp: where it began, and where it ended, right or not
  };
  std::vector<Try> tries;
  std::vector<ClosureTest> gate;  ///< of the transform against odometry and its neighbours
};

Evidence evidenceOf(const LoopClosure& closure);

/// Lines of comma separated values: anybody can read them.
std::string printEvidence(const Evidence& evidence);
/// DataError naming the line where the text is something else.
Evidence parseEvidence(std::string_view text);
/// The part of a longer text that printEvidence() wrote, up to its end; empty where there is none.
std::string_view evidenceIn(std::string_view text);

}  // namespace loop_metric
