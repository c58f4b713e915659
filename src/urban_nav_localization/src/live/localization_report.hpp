// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "live/live_localiser.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace urban_nav_localization {

/// Fault of the stage as a whole; a state other than Localized is no fault. Numbers are part of messages: new ones are
/// appended.
enum class StageFault {
  None = 0,
  NoOdometry = 1,  ///< missing or silent
  NoMap = 2,       ///< the map has no keyframes of this camera, or is damaged
  NoCamera = 3,    ///< the two camera_info make no stereo camera
  NoImages = 4,
  ReadingMap = 5,  ///< keyframes of the map are still being read
};
/// Returns "None", "NoOdometry", ...
const char* toString(StageFault fault);

/// State of the stage, of which its report is made.
struct StageState {
  bool paused = false;          ///< no fault is reported
  bool compares_images = true;  ///< false: images are not subscribed, or the map has no keyframes
  LiveLocaliser::State localiser;
  std::string map;                          ///< path of the store
  std::string odometry_fault, image_fault;  ///< of topics; empty: none
  std::string camera_fault, laser_pose_fault;
  std::string camera;  ///< how it is mounted
  std::int64_t initial_poses_refused = 0, damaged_images = 0;
};

/// Returns the report: the most severe fault first, else the state of the localization, then figures.
urban_nav_live::StageReport makeReport(const StageState& state);

}  // namespace urban_nav_localization
