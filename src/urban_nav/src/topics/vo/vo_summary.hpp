// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "topics/vo/vo_run.hpp"

namespace urban_nav {

/// Figures of visual odometry for summary.json and the report.
struct VoSummary {
  std::int64_t frames = 0;
  std::int64_t dropped = 0;  ///< because of their stamps
  double ms_median = 0.0, ms_p99 = 0.0;
  double features_mean = 0.0, track_length_mean = 0.0, reprojection_px_mean = 0.0;
  double disparity_offset_px = 0.0, disparity_offset_sigma_px = 0.0;  ///< final estimate for the camera
  double row_offset_px = 0.0;                                         ///< final estimate
  swf_vo::RigConstants rig;                                           ///< final estimate
  swf_vo::MotionEstimates motion;                                     ///< of the last session, at its end
  std::map<std::string, std::int64_t> status_counts;                  ///< OK, DEGRADED, LOST, RECOVERED: all four
  std::map<std::string, std::int64_t> reason_counts;                  ///< of frames that have one
  /// Faults of the data; frames that were LOST, by reason; constants of the rig and motion sensors that the images
  /// contradict. Each begins with its input.
  std::vector<std::string> warnings;
};

/// Summarises a session. `parameters`: of the run; their priors determine significant deviations.
VoSummary summarise(const VoRun& run, const swf_vo::Parameters& parameters = swf_vo::Parameters());

/// Summarises several sessions: counts and distances are added, medians are of all frames together.
VoSummary summarise(const std::vector<const VoRun*>& runs, const swf_vo::Parameters& parameters = swf_vo::Parameters());

/// Returns the object "swf_vo" of summary.json.
Json toJson(const VoSummary& summary);

}  // namespace urban_nav
