// SPDX-License-Identifier: BSD-3-Clause
#include "live/loops_report.hpp"

#include <utility>

namespace loop_metric {

namespace {

std::pair<StageFault, std::string> findFault(const LoopsState& state) {
  if (state.paused) return {StageFault::None, ""};
  if (!state.store.fault.empty()) return {StageFault::NotStored, "nothing is stored: " + state.store.fault};
  if (!state.odometry_fault.empty()) return {StageFault::NoOdometry, state.odometry_fault};
  if (state.stereo && !state.camera_fault.empty()) return {StageFault::NoCamera, state.camera_fault};
  if (state.stereo && !state.image_fault.empty()) return {StageFault::NoImages, "no keyframes: " + state.image_fault};
  if (!state.clouds) return {StageFault::None, ""};
  // Sweeps of a 3D LiDAR make complete clouds alone.
  if (!state.laser_fault.empty() && state.recorder.sweeps == 0)
    return {StageFault::NoLasers, "no complete clouds: " + state.laser_fault};
  if (!state.laser_pose_fault.empty()) return {StageFault::NoLaserPlace, state.laser_pose_fault};
  return {StageFault::None, ""};
}

}  // namespace

const char* toString(StageFault fault) {
  switch (fault) {
    case StageFault::None: return "None";
    case StageFault::NoOdometry: return "NoOdometry";
    case StageFault::NotStored: return "NotStored";
    case StageFault::NoCamera: return "NoCamera";
    case StageFault::NoImages: return "NoImages";
    case StageFault::NoLasers: return "NoLasers";
    case StageFault::NoLaserPlace: break;
  }
  return "NoLaserPlace";
}

std::string givenUp(std::int64_t candidates) {
  return std::to_string(candidates) +
         " candidates of loop closures were dropped: not measured within drain_s; raise it";
}

urban_nav_live::StageReport makeReport(const LoopsState& state) {
  urban_nav_live::StageReport report;
  const auto [fault, sentence] = findFault(state);
  if (fault != StageFault::None) report.status = {urban_nav_core::Health::Degraded, static_cast<int>(fault), sentence};
  report.reason_name = toString(fault);
  report.is_error = fault == StageFault::NotStored;
  if (state.stereo && !state.paused) report.warn(state.camera);
  state.beams.addTo(report);
  report.add("session", state.recorder.session);
  report.add("parts of its odometry", state.verifier.parts);
  report.add("keyframes stored", state.recorder.keyframes.extracted);
  report.add("stereo pairs", state.recorder.keyframes.pairs);
  report.add("stereo pairs without odometry", state.recorder.keyframes.without_odometry);
  report.add("images damaged", state.damaged_images);
  report.add("scans", state.recorder.scans);
  report.add("sweeps stored", state.recorder.sweeps);
  report.add("candidates", state.candidates);
  report.add("candidates by the similarity of clouds", state.verifier.proposed);
  report.add("candidates that wait", state.verifier.waiting);
  report.add("accepted by stereo", state.verifier.stereo);
  report.add("accepted by ICP", state.verifier.icp);
  report.add("rejected", state.verifier.rejected);
  report.add("last verdict", state.last_verdict);
  report.add("time of the last candidate (ms)", state.last_ms);
  report.add("dropped by the verifier: queue full", state.verifier.dropped);
  report.add("dropped: before odometry", state.recorder.not_stored);
  report.add("steps of odometry rejected", state.recorder.refused_steps);
  report.add("camera", state.camera);
  addStoreFigures(state.store, report);
  return report;
}

}  // namespace loop_metric
