// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_odometry.hpp"

#include <chrono>

namespace swf_vo {

namespace {

// ns; as long as the window of urban_nav_live::FaultRates
constexpr urban_nav_core::StampNs kNewSession = 10'000'000'000;
// Motion inputs kept for the propagation of the next frame: of longer than a frame can be delayed, ns.
constexpr urban_nav_core::StampNs kLongestAhead = 10'000'000'000;

}  // namespace

void LiveOdometry::begin(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left) {
  filter_ = std::make_unique<SwfVo>(parameters_, camera, T_base_left);
  fault_.clear();
  motion_ = MotionEstimates();
  skipped_inputs_.clear();
  propagation_.reset();
  ahead_.clear();
  begin_ = newest_ = propagated_ = 0;
  ++sessions_;
}

void LiveOdometry::process(const urban_nav_core::StereoPairWithMotion& pair, double backlog) {
  skipped_inputs_.insert(skipped_inputs_.end(), pair.inputs.begin(), pair.inputs.end());
  if (!thinning_.keeps(backlog)) {
    ++skipped_;
    return;
  }
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const Frame& frame = filter_->process(pair.pair, skipped_inputs_);
  skipped_inputs_.clear();
  process_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  ++frames_;
  newest_ = frame.stamp;
  status_ = frame.status;
  const bool is_image_missing = status_.reason == static_cast<int>(Reason::ImageMissing);  // counted by StereoSessions
  if (status_.health == urban_nav_core::Health::Lost && !is_image_missing) ++lost_frames_;
  statistics_ = frame.statistics;
  if (frame.frame == 0) {
    begin_ = frame.stamp;
    session_ = urban_nav_live::toOdometrySession(namer_.begin(recording_, begin_).session);
  }
  for (std::size_t i = motion_.faults.size(); listener_.warning && i < frame.motion.faults.size(); ++i)
    listener_.warning(describe(frame.motion.faults[i], begin_));
  motion_ = frame.motion;
  if (listener_.frame) listener_.frame(frame, pair.pair, process_ms_);
  if (listener_.propagated && frame.accepted) restartPropagation();
}

void LiveOdometry::restartPropagation() {
  while (!ahead_.empty() && ahead_.front().to <= newest_) ahead_.pop_front();
  propagation_ = filter_->propagation();
  for (const urban_nav_core::MotionInput& input : ahead_)
    if (input.to > newest_) propagation_->add(input);
}

void LiveOdometry::addMotion(const urban_nav_core::MotionInput& input) {
  if (!filter_ || !listener_.propagated) return;
  ahead_.push_back(input);
  while (ahead_.front().to < input.to - kLongestAhead) ahead_.pop_front();
  if (!propagation_ || input.to <= newest_) return;
  const std::optional<PropagatedPose> pose = propagation_->add(input);
  if (!pose || pose->stamp <= propagated_) return;
  propagated_ = pose->stamp;
  listener_.propagated(*pose);
}

void LiveOdometry::end(const std::string& why) {
  if (!filter_) return;
  for (const Settled& settled : filter_->flush())
    if (listener_.settled) listener_.settled(settled);
  filter_.reset();
  propagation_.reset();
  waiting_ = "no session (" + why + ")";
  previous_end_ = why == kReset || why == kFinished ? "" : why;
}

urban_nav_live::StageReport LiveOdometry::report() const {
  urban_nav_live::StageReport report;
  report.status = status_;
  report.reason_name = toString(static_cast<Reason>(status_.reason));
  if (!filter_) {
    report.status.health = urban_nav_core::Health::Ok;  // no frame; the warning below determines the level
    report.summary = fault_.empty() ? waiting_ : fault_;
    report.is_warning = true;
  } else if (!previous_end_.empty() && newest_ - begin_ < kNewSession) {
    report.warn("a new session began, because " + previous_end_);
  }
  report.add("features", statistics_.features);
  report.add("tracked", statistics_.tracked);
  report.add("reprojection error (px)", statistics_.reprojection_px);
  report.add("disparity offset (px)", statistics_.disparity_offset_px);
  report.add("row offset (px)", statistics_.row_offset_px);
  if (motion_.has_gyroscope && !motion_.gyroscope_left_out) {
    report.add("bias of the gyroscope (rad/s)", motion_.gyroscope_bias.norm());
    report.add("delay of the IMU (ms)", 1e3 * motion_.imu_offset_s);
  }
  if (motion_.has_wheels && !motion_.wheels_left_out)
    report.add("measured over true speed of the wheels", motion_.wheel_scale);
  report.add("motion sensors left out", (motion_.gyroscope_left_out ? 1 : 0) + (motion_.wheels_left_out ? 1 : 0));
  report.add("ratio of observed to predicted noise", statistics_.noise_scale);
  report.add("time of the last frame (ms)", process_ms_);
  report.add("frames", frames_);
  report.add("frames lost", lost_frames_);
  report.add("pairs skipped", skipped_);
  report.fault_counts.push_back({"pairs were skipped", skipped_, frames_ + skipped_,
                                 "the stage is slower than the camera; lower `features` or the rate of the camera, or "
                                 "free processor time"});
  report.fault_counts.push_back({"frames have a pose by prediction only", lost_frames_, frames_,
                                 "too few features: check lens, light and exposure, or drive more slowly"});
  report.add("sessions", sessions_);
  report.add("session", urban_nav_core::sessionId(session_));
  return report;
}

}  // namespace swf_vo
