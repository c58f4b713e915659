// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "loop_metric/loop_metric.hpp"

namespace loop_metric {

/// Data of a verdict, small enough to be stored for every candidate; shown by `urban_nav why`.
struct Evidence {
  struct Try {
    urban_nav_core::ClosureMethod method = urban_nav_core::ClosureMethod::None;
    urban_nav_core::PoseRef keyframe_a,
        keyframe_b;  ///< stereo: matched keyframes; icp: poses of the clouds
    urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Rejected;
    std::string reason, sentence;
    std::vector<urban_nav_registration::ClosureTest> tests;
    std::vector<urban_nav_registration::MatchedPixels> pixels;  ///< stereo: at most a hundred, evenly selected
    std::optional<urban_nav_core::Pose> guess, T_a_b;           ///< icp: initial and final pose, accepted or not
  };
  std::vector<Try> tries;
  std::vector<urban_nav_registration::ClosureTest> gate;  ///< tests of the transform against odometry and neighbouring
                                                          ///< closures
};

/// Returns the evidence of a measured closure.
Evidence collectEvidence(const CandidateMeasurement& measurement);

/// Returns the evidence as lines of comma separated values.
std::string printEvidence(const Evidence& evidence);
/// Parses printEvidence(). Throws DataError naming the line for any other text.
Evidence parseEvidence(std::string_view text);
/// Returns the part of a longer text written by printEvidence(), up to its end; empty if there is none.
std::string_view evidenceIn(std::string_view text);

}  // namespace loop_metric
