// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swf_vo/swf_vo.hpp"
#include "urban_nav_core/sequence/stereo_assembler.hpp"
#include "urban_nav_live/pair_thinning.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace swf_vo {

/// Visual odometry of a live robot: one filter per session, and a report for the operator. Names the sessions of the
/// robot. Used by one thread.
class LiveOdometry {
 public:
  /// Reasons for the end of a session by the operator.
  static constexpr const char *kReset = "reset", *kFinished = "finished";
  struct Listener {
    std::function<void(const Frame& frame, const urban_nav_core::StereoPair& pair, double process_ms)> frame;
    /// Receives smoothed poses that leave the window when a session ends.
    std::function<void(const Settled& settled)> settled;
    /// Receives the message when a motion sensor is excluded; once for each exclusion.
    std::function<void(const std::string& text)> warning;
    /// Receives poses between frames, in order of time; they are computed only if it is set.
    std::function<void(const PropagatedPose& pose)> propagated = {};
  };

  /// `robot`, `recording`: parts of the session ids; may be empty.
  LiveOdometry(const Parameters& parameters, Listener listener, const std::string& robot = "",
               std::string recording = "")
      : parameters_(parameters), listener_(std::move(listener)), recording_(std::move(recording)), namer_(robot) {}

  /// Begins a session. `T_base_left`: pose of the rectified left camera. Throws UserError if the calibration is
  /// invalid.
  void begin(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left);
  /// Processes a pair, or skips it because of overload (urban_nav_live::PairThinning): its motion inputs are then used
  /// with the next pair that is processed. `backlog`: waiting inputs as a share of the queue's capacity. Requires a
  /// running session.
  void process(const urban_nav_core::StereoPairWithMotion& pair, double backlog = 0.0);
  /// Propagates the pose of the newest frame by a motion input that the filter has not received yet. Inputs of a sensor
  /// must be added in order of time. Frames are the same with and without it.
  void addMotion(const urban_nav_core::MotionInput& input);
  /// Ends the session: flushes smoothed poses to the listener. `why`: for the report, which warns of it for the first
  /// seconds of the next session, unless it is kReset or kFinished.
  void end(const std::string& why);
  /// Sets the reason why no session can begin; empty: no fault.
  void setFault(const std::string& fault) { fault_ = fault; }

  bool isRunning() const { return filter_ != nullptr; }
  std::int64_t sessions() const { return sessions_; }
  /// Returns the session of the newest frame; null before the first.
  const urban_nav_core::OdometrySessionPtr& session() const { return session_; }
  /// Status of the newest frame.
  const urban_nav_core::Status& status() const { return status_; }
  /// Returns the report for the operator: a warning while there is no session.
  urban_nav_live::StageReport report() const;

 private:
  void restartPropagation();

  const Parameters parameters_;
  const Listener listener_;
  const std::string recording_;
  urban_nav_live::SessionNamer namer_;
  urban_nav_live::PairThinning thinning_;
  urban_nav_core::OdometrySessionPtr session_;
  std::unique_ptr<SwfVo> filter_;
  urban_nav_core::Status status_;
  Statistics statistics_;
  MotionEstimates motion_;
  urban_nav_core::StampNs begin_ = 0, newest_ = 0;  // first and newest frame of the session
  double process_ms_ = 0.0;
  std::int64_t frames_ = 0, lost_frames_ = 0, sessions_ = 0, skipped_ = 0;
  std::vector<urban_nav_core::MotionInput> skipped_inputs_;  // since the last processed pair
  std::optional<Propagation> propagation_;              // of the newest frame
  std::deque<urban_nav_core::MotionInput> ahead_;       // later than the newest frame
  urban_nav_core::StampNs propagated_ = 0;              // newest stamp of a pose between frames
  std::string waiting_ = "no images yet", fault_;
  std::string previous_end_;  // why the previous session ended; empty: none, or by the operator
};

}  // namespace swf_vo
