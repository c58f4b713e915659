// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/frame_measurements.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/sequence/change_detector.hpp"
#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/covariance_scale.hpp"
#include "urban_nav_trust/parameters.hpp"

namespace urban_nav_trust {

constexpr const char* kTurnTest = "gyroscope_turn";
constexpr const char* kSpeedTest = "wheel_speed";
constexpr const char* kDirectionTest = "wheel_direction";
constexpr const char* kClockTest = "imu_clock";

/// Tests stereo odometry against gyroscope and wheels in windows of one second: turns must agree, by the largest
/// chi-square of all windows; constants (ratio of lengths, direction of travel in base_link, delay of the clocks) must
/// not change. Derivation: docs/derivations/trust.md. Not thread-safe.
class MotionMonitor {
 public:
  explicit MotionMonitor(const Parameters& parameters);

  /// Adds a frame, in order of time. Returns whether it reveals a change.
  bool add(const urban_nav_core::FrameMeasurements& frame);
  /// Adds a final step of odometry, in order of time, whose drift enters the evidence.
  void add(const urban_nav_core::RelativePose& step);
  std::vector<ConsistencyTest> tests() const;
  std::vector<AbsentMeasurement> absent() const;
  /// Return the evidence of gyroscope and wheels on the scale of odometry's covariance.
  ScaleEvidence turnEvidence() const { return turn_evidence_.evidence(); }
  ScaleEvidence lengthEvidence() const { return length_evidence_.evidence(); }

 private:
  /// Sums over the steps of a window.
  struct Window {
    Interval interval;
    Eigen::Vector3d turn_error = Eigen::Vector3d::Zero();
    double turn_variance = 0.0, forward = 0.0, sideways = 0.0, forward_error = 0.0, forward_variance = 0.0;
    int turns = 0, moves = 0;
  };
  /// Constant measured in windows.
  struct Constant {
    explicit Constant(const Parameters& parameters);
    urban_nav_core::ChangeDetector detector;
    bool add(const urban_nav_core::ConstantMeasurement& measurement) { return detector.add(measurement); }
  };
  struct Wording {
    const char *name, *quantity, *unit, *remedy;
    double per_unit;
  };
  bool closeTurnWindow();
  bool closeMoveWindow();
  void addLengthEvidence();
  bool addClock(const urban_nav_core::FrameMeasurements& frame);
  static std::optional<ConsistencyTest> makeTest(const Wording& wording, const Constant& constant);
  std::optional<ConsistencyTest> turnTest() const;

  double false_alarm_;
  Window turn_, move_;
  std::int64_t turn_windows_ = 0;
  double largest_turn_ = 0.0;  // chi-square of the worst window
  Window worst_turn_;
  Interval turn_span_;
  Constant speed_, direction_, clock_;
  WindowEvidence turn_evidence_, length_evidence_;
  double turn_drift_ = 0.0, forward_drift_ = 0.0;  // variances since the last window: rad^2, m^2
  urban_nav_core::StampNs last_ = 0, clock_due_ = 0;
  bool any_frame_ = false;
};

}  // namespace urban_nav_trust
