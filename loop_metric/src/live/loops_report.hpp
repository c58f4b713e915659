// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "live/closure_verifier.hpp"
#include "live/session_recorder.hpp"
#include "urban_nav_live/beam_faults.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace loop_metric {

/// Fault of the stage as a whole. Numbers are part of messages: new ones are appended.
enum class StageFault {
  None = 0,
  NoOdometry = 1,    ///< missing or silent: candidates wait, then are measured with what is stored
  NotStored = 2,     ///< keyframes and scans do not reach the store
  NoCamera = 3,      ///< the two camera_info make no stereo camera
  NoImages = 4,      ///< no keyframes are extracted
  NoLasers = 5,      ///< no scans although clouds may be used
  NoLaserPlace = 6,  ///< a laser without a pose on the robot
};
/// Returns "None", "NoOdometry", ...
const char* toString(StageFault fault);

/// State of the stage, of which its report is made.
struct LoopsState {
  bool stereo = true, clouds = true;  ///< they are used
  bool paused = false;                ///< no fault is reported
  SessionRecorder::State recorder;
  ClosureVerifier::Counts verifier;
  urban_nav_live::StoreState store;
  std::string odometry_fault, image_fault, laser_fault;  ///< of topics; empty: none
  std::string camera_fault, laser_pose_fault;
  std::string camera;  ///< how it is mounted
  urban_nav_live::BeamFaults beams;
  std::int64_t candidates = 0, damaged_images = 0;
  std::string last_verdict;
  double last_ms = 0.0;
};

/// Returns the sentence on candidates that were not measured before the end of the stage.
std::string givenUp(std::int64_t candidates);
/// Returns the report: the most severe fault first, then figures.
urban_nav_live::StageReport makeReport(const LoopsState& state);

}  // namespace loop_metric
