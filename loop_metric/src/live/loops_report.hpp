// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "live/closure_verifier.hpp"
#include "live/session_recorder.hpp"
#include "urban_nav_live/beam_faults.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace loop_metric {

/// Fault of the whole stage. Values are part of messages: append new ones at the end.
enum class StageFault {
  None = 0,
  NoOdometry = 1,    ///< missing or silent: candidates wait, then are measured with the stored data
  NotStored = 2,     ///< keyframes and scans are not stored
  NoCamera = 3,      ///< the two camera_info do not form a stereo camera
  NoImages = 4,      ///< no keyframes are extracted
  NoLasers = 5,      ///< no scans although clouds may be used
  NoLaserPlace = 6,  ///< a laser has no extrinsics
};
/// Returns "None", "NoOdometry", ...
const char* toString(StageFault fault);

/// State of the stage for its report.
struct LoopsState {
  bool stereo = true, clouds = true;  ///< enabled
  bool paused = false;                ///< no faults are reported
  SessionRecorder::State recorder;
  ClosureVerifier::Counts verifier;
  urban_nav_live::StoreState store;
  std::string odometry_fault, image_fault, laser_fault;  ///< faults of topics; empty: none
  std::string camera_fault, laser_pose_fault;
  std::string camera;  ///< description of its mounting
  urban_nav_live::BeamFaults beams;
  std::int64_t candidates = 0, damaged_images = 0;
  std::string last_verdict;
  double last_ms = 0.0;
};

/// Returns the message on candidates that were not measured before the end of the stage.
std::string givenUp(std::int64_t candidates);
/// Returns the report: the most severe fault first, then statistics.
urban_nav_live::StageReport makeReport(const LoopsState& state);

}  // namespace loop_metric
