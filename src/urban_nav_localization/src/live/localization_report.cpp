// SPDX-License-Identifier: BSD-3-Clause
#include "live/localization_report.hpp"

#include <utility>

namespace urban_nav_localization {

namespace {

std::pair<StageFault, std::string> findFault(const StageState& state) {
  const LiveLocaliser::State& localiser = state.localiser;
  if (state.paused) return {StageFault::None, ""};
  if (!localiser.map_fault.empty()) return {StageFault::NoMap, localiser.map_fault};
  if (!state.odometry_fault.empty()) return {StageFault::NoOdometry, state.odometry_fault};
  if (state.compares_images && !state.camera_fault.empty()) return {StageFault::NoCamera, state.camera_fault};
  if (state.compares_images && !state.image_fault.empty()) return {StageFault::NoImages, state.image_fault};
  if (localiser.map_keyframes_read < localiser.map_keyframes)
    return {StageFault::ReadingMap, "reading the map: " + std::to_string(localiser.map_keyframes_read) + " of " +
                                        std::to_string(localiser.map_keyframes) + " keyframes"};
  return {StageFault::None, ""};
}

}  // namespace

const char* toString(StageFault fault) {
  switch (fault) {
    case StageFault::None: return "None";
    case StageFault::NoOdometry: return "NoOdometry";
    case StageFault::NoMap: return "NoMap";
    case StageFault::NoCamera: return "NoCamera";
    case StageFault::NoImages: return "NoImages";
    case StageFault::ReadingMap: break;
  }
  return "ReadingMap";
}

urban_nav_live::StageReport makeReport(const StageState& state) {
  const LiveLocaliser::State& localiser = state.localiser;
  const LocalizationEstimate& estimate = localiser.estimate;
  urban_nav_live::StageReport report;
  const auto [fault, sentence] = findFault(state);
  if (fault != StageFault::None) {
    report.status = {urban_nav_core::Health::Degraded, static_cast<int>(fault), sentence};
  } else {
    report.summary = toString(estimate.state) + std::string(": ") + estimate.sentence;
    report.is_warning = estimate.state != LocalizationState::Localized;
  }
  report.reason_name = toString(fault);
  report.is_error = fault == StageFault::NoMap;
  if (!state.paused) report.warn(state.camera);
  report.add("state", toString(estimate.state));
  report.add("why", toString(estimate.reason));
  report.add("supporting matches", estimate.supporting_matches);
  report.add("probability", estimate.probability);
  report.add("map", state.map);
  report.add("keyframes of the map", localiser.map_keyframes);
  report.add("keyframes of the map read", localiser.map_keyframes_read);
  report.add("keyframe queries", localiser.queries);
  report.add("keyframe matches", localiser.matches);
  report.add("time of the last keyframe query (ms)", localiser.query_ms);
  report.add("places of the map", localiser.map_places);
  report.add("places of the map read", localiser.map_places_read);
  report.add("cloud queries", localiser.cloud_queries);
  report.add("cloud matches", localiser.cloud_matches);
  report.add("time of the last cloud query (ms)", localiser.cloud_query_ms);
  report.add("scans", localiser.scans);
  report.add("sweeps", localiser.sweeps);
  report.add("lasers", !state.laser_pose_fault.empty()          ? state.laser_pose_fault
                       : localiser.scans + localiser.sweeps > 0 ? "ok"
                                                                : "none");
  report.add("stereo pairs", localiser.keyframes.pairs);
  report.add("stereo pairs without odometry", localiser.keyframes.without_odometry);
  report.add("images damaged", state.damaged_images);
  report.add("initial poses taken", localiser.initial_poses);
  report.add("initial poses rejected", state.initial_poses_refused);
  report.add("restarts", localiser.restarts);
  report.add("dropped: keyframes that waited", localiser.dropped_keyframes);
  report.add("steps of odometry rejected", localiser.refused_steps);
  report.add("camera", state.camera);
  return report;
}

}  // namespace urban_nav_localization
