// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/sequence/change_detector.hpp"
#include "urban_nav_core/types/frame_measurements.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
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
/// not change, and the delay must be one that transport explains. A sensor that odometry excludes fails its test.
/// Derivation: docs/derivations/trust.md. Not thread-safe.
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
    Eigen::Vector3d turn = Eigen::Vector3d::Zero(), turn_error = Eigen::Vector3d::Zero();
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
  /// Exclusion of a sensor by odometry.
  struct Exclusion {
    Interval interval;      // of frames, from the first to the last exclusion
    std::string sentence;   // of the last frame, which is the most precise
    bool is_there = false;  // in the newest frame
    /// Returns whether an exclusion begins with this frame.
    bool add(const std::string& fault, urban_nav_core::StampNs last, urban_nav_core::StampNs stamp);
    bool any() const { return !sentence.empty(); }
    /// Makes the test fail. It is corrected if odometry uses the sensor again.
    void applyTo(const std::string& sensor, ConsistencyTest& test) const;
  };
  bool closeTurnWindow();
  bool closeMoveWindow();
  void addLengthEvidence();
  bool addClock(const urban_nav_core::FrameMeasurements& frame);
  // Standard deviations by which the newest delay of the IMU exceeds that of a transfer, and its probability.
  double excessDelay() const;
  double delayProbability() const;
  static std::optional<ConsistencyTest> makeTest(const Wording& wording, const Constant& constant);
  std::optional<ConsistencyTest> turnTest() const;
  // States a scale, if it explains most of the difference of the worst window.
  void nameTurnScale(ConsistencyTest& test) const;
  std::optional<ConsistencyTest> speedTest() const;
  std::optional<ConsistencyTest> clockTest() const;

  double false_alarm_;
  Window turn_, move_;
  std::int64_t turn_windows_ = 0;
  double scale_information_ = 0.0, scale_weighted_ = 0.0;  // of the excess of turns by stereo, relative
  double largest_turn_ = 0.0;                              // chi-square of the worst window
  Window worst_turn_;
  Interval turn_span_;
  Constant speed_, direction_, clock_;
  Exclusion no_gyroscope_, no_wheels_;
  double imu_delay_ = 0.0, imu_delay_sigma_ = 0.0, wheel_delay_ = 0.0, wheel_delay_sigma_ = 0.0;  // newest, s
  WindowEvidence turn_evidence_, length_evidence_;
  double turn_drift_ = 0.0, forward_drift_ = 0.0;  // variances since the last window: rad^2, m^2
  urban_nav_core::StampNs last_ = 0, clock_due_ = 0;
  bool any_frame_ = false;
};

}  // namespace urban_nav_trust
