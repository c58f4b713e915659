// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "topics/lo/lo_run.hpp"

namespace urban_nav {

/// Figures of laser odometry for summary.json and the report.
struct LoSummary {
  std::int64_t sweeps = 0;
  std::int64_t dropped = 0;     ///< because of their stamps
  std::int64_t degenerate = 0;  ///< registered sweeps with a free direction
  double ms_median = 0.0, ms_p99 = 0.0;
  double points_mean = 0.0;
  double moving_share = 0.0;                          ///< of the beams on matched surfaces
  double residual_mean = 0.0;                         ///< m
  bool deskewed = false;                              ///< the motion within sweeps was compensated, by this stage
  std::map<std::string, std::int64_t> status_counts;  ///< OK, DEGRADED, LOST, RECOVERED: all four
  std::map<std::string, std::int64_t> reason_counts;  ///< of sweeps that have one
  urban_nav_core::MotionEstimates motion;             ///< of the last session, at its end
  std::vector<std::string> reason_sentences;          ///< reasons with their inputs, for the user
  std::vector<std::string> warnings;  ///< faults of the data and `reason_sentences`; each with its input
};

/// Returns the summary over several sessions; medians are of all sweeps together.
LoSummary summariseLo(const std::vector<const LoRun*>& runs);

/// Returns the object "laser_odometry" of summary.json.
Json toJson(const LoSummary& summary);

}  // namespace urban_nav
