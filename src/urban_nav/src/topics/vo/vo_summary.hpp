// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "topics/vo/vo_run.hpp"

namespace urban_nav {

/// The figures of a run of visual odometry that summary.json and the report show.
struct VoSummary {
  std::int64_t frames = 0;
  std::int64_t dropped = 0;  ///< because of their stamps
  double ms_median = 0.0, ms_p99 = 0.0;
  double features_mean = 0.0, track_length_mean = 0.0, reprojection_px_mean = 0.0;
  double disparity_offset_px = 0.0, disparity_offset_sigma_px = 0.0;  ///< of the camera, as known in the end
  double row_offset_px = 0.0;                                         ///< likewise
  swf_vo::RigConstants rig;                                           ///< likewise
  swf_vo::MotionEstimates motion;                                     ///< of the last session, at its end
  std::map<std::string, std::int64_t> status_counts;                  ///< OK, DEGRADED, LOST, RECOVERED: all four
  std::map<std::string, std::int64_t> reason_counts;                  ///< of frames that have one
  /// Faults of the data; frames that were LOST, by reason; constants of the rig and motion sensors that the images
  /// contradict. Each begins with its input.
  std::vector<std::string> warnings;
};

/// `parameters`: of the run; its priors say what is outside.
VoSummary summarise(const VoRun& run, const swf_vo::Parameters& parameters = swf_vo::Parameters());

/// Over several sessions: counts and distances add up, medians are of all frames together.
VoSummary summarise(const std::vector<const VoRun*>& runs, const swf_vo::Parameters& parameters = swf_vo::Parameters());

/// The object "swf_vo" of summary.json.
Json toJson(const VoSummary& summary);

}  // namespace urban_nav
