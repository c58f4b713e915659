// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/status.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_trust/assessment.hpp"
#include "urban_nav_trust/trust_monitor.hpp"

namespace urban_nav_trust {

/// Stereo frame as published by odometry.
struct LiveFrame {
  urban_nav_core::StampNs stamp = 0;
  bool accepted = true;
  urban_nav_core::Health health = urban_nav_core::Health::Ok;
  urban_nav_core::FrameMeasurements compared;
};

/// Pose of odometry with its covariance.
struct LivePose {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::PoseWithCovariance T_odom_base;
};

/// Final step of odometry, received when it has left the window: later than its frame, so not used as time reference.
struct LiveStep {
  urban_nav_core::StampNs stamp = 0;  ///< of its end pose
  urban_nav_core::RelativePose step;
};

/// Trust in the current pose.
struct LiveEstimate {
  FrameTrust frame;
  std::string reason;  ///< why the state is not KNOWN; empty if it is
  TestResults results;
};

/// Reason why the stage is not OK.
enum class Reason { None = 0, CalibrationChanged = 1, OdometryLost = 2 };
/// Returns "none", "calibration_changed" or "odometry_lost".
const char* toString(Reason reason);

/// Trust in the poses of a live robot. A backward jump of stamps begins a new session. No history of poses is kept.
/// Used by one thread.
class LiveTrust {
 public:
  using Listener = std::function<void(const LiveEstimate&)>;
  /// `listener`: receives an estimate with each pose if state or tests have changed, otherwise once a second.
  LiveTrust(const Parameters& parameters, Listener listener);

  void add(const LiveFrame& frame);
  void add(const LiveStep& step);
  void add(const LivePose& pose);
  /// Begins a new session.
  void reset();
  /// Returns LOST while odometry is lost, and DEGRADED (calibration_changed) after a change: to the end of the session,
  /// or, if odometry corrected it, until all landmarks were created with the new mounting.
  urban_nav_core::Status status() const;
  urban_nav_live::StageReport report() const;

 private:
  LiveEstimate assess(const LivePose& pose) const;
  /// Returns whether a test fails whose cause affects the newest pose.
  bool isPresent(const ConsistencyTest& test) const;
  /// Returns whether a test failed in the last estimate whose cause was not corrected.
  bool hasLastingFailure() const;

  const Parameters parameters_;
  const Listener listener_;
  TrustMonitor monitor_;
  urban_nav_core::StampNs newest_ = 0, published_ = 0;
  urban_nav_core::Health health_ = urban_nav_core::Health::Ok;
  std::optional<Eigen::Vector3d> position_;
  double travelled_ = 0.0;            // m
  std::optional<double> changed_at_;  // travelled_ at the first change of a constant that was not corrected
  std::optional<LiveEstimate> last_;  // last published estimate
  std::int64_t frames_ = 0, poses_ = 0;
};

}  // namespace urban_nav_trust
