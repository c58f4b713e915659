// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_core {

/// Step between two frames, measured by the reference (images or sweeps) only. One part of its error accumulates over
/// steps (drift); the other is the error of the pose at the end of the step, which the next step reverses.
struct ReferenceStep {
  double seconds = 0.0;
  Vector3d rotation = Vector3d::Zero();             ///< rotation vector of R_from_to of base_link
  double forward = 0.0;                             ///< m, along x of base_link at `from`
  double rotation_drift = 0.0, rotation_end = 0.0;  ///< variances about an axis, rad^2
  double forward_drift = 0.0, forward_end = 0.0;    ///< variances, m^2
};

/// Difference between a step by the reference and by a gyroscope, in the axes of base_link at its end: error =
/// reference - gyroscope = bias d(bias) + offset d(offset) + noise, with d = true - estimated.
struct GyroscopeStep {
  Vector3d error = Vector3d::Zero();   ///< rad
  Matrix3d bias = Matrix3d::Zero();    ///< s
  Vector3d offset = Vector3d::Zero();  ///< rad/s
  double variance = 0.0;               ///< noise about an axis, rad^2
};

/// Difference between a step by the reference and by wheels, as in GyroscopeStep: along x (m), and about z (rad).
struct WheelStep {
  struct Part {
    double error = 0.0, scale = 0.0, offset = 0.0, variance = 0.0;
  };
  Part forward, turn;
};

/// Slowly varying states of motion sensors and their covariance.
struct MotionStates {
  static constexpr int kBias = 0, kImuOffset = 3, kSpeedScale = 4, kTurnScale = 5, kWheelOffset = 6, kSize = 7;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  /// Gyroscope bias (rad/s, in base_link); delay of its stamps (s); measured over true speed and measured over true yaw
  /// rate of the wheels, minus 1; delay of the wheels' stamps (s).
  Vector mean = Vector::Zero();
  Matrix covariance = Matrix::Identity();

  Vector3d bias() const { return mean.segment<3>(kBias); }
};

/// Standard deviations of the priors.
constexpr double kBiasPrior = 0.1;         ///< rad/s
constexpr double kOffsetPrior = 0.05;      ///< s
constexpr double kSpeedScalePrior = 0.05;  ///< relative
constexpr double kTurnScalePrior = 0.2;    ///< relative: tracks and tyres scrub

/// Estimates bias, scales and time offsets of motion sensors from steps measured by the reference only, with an
/// extended Kalman filter whose states are random walks. The pose error of the frame between two successive steps is a
/// state as well, so that errors of the reference and of encoders accumulate at the correct rate. The reference is
/// independent of the sensors, so no information is counted twice (docs/derivations/motion_sensors.md). Not
/// thread-safe.
class MotionCalibration {
 public:
  MotionCalibration();

  /// Updates with a step. `follows`: it begins where the previous step ended.
  void update(const ReferenceStep& reference, bool follows, const std::optional<GyroscopeStep>& gyroscope,
              const std::optional<WheelStep>& wheels);
  /// Adds process noise for a time span, s.
  void advance(double seconds);
  /// Resets the states of one sensor to their priors.
  void forgetGyroscope();
  void forgetWheels();

  const MotionStates& states() const { return states_; }
  /// Returns the noise variance of a sensor relative to the stated variance.
  double gyroscopeNoise() const { return noise_[0]; }
  double wheelNoise() const { return noise_[1]; }

  void archive(Archive& archive);

 private:
  static constexpr int kEnds = 5;  // end states of a frame: rotation, forward, and yaw by wheels
  static constexpr int kAll = MotionStates::kSize + 2 * kEnds;
  using Row = Eigen::Matrix<double, kAll, 1>;
  using Joint = Eigen::Matrix<double, kAll, kAll>;

  void beginStep(const ReferenceStep& reference, bool follows);
  void measure(const Row& row, double error, double variance, int sensor);
  void endStep();
  void forget(int first, int count);
  void restorePrior(int state);

  MotionStates states_;
  Joint P_ = Joint::Zero();                          // states, ends of the previous frame, ends of this frame
  Row change_ = Row::Zero();                         // change of the estimates in a step; ends are zero before
  Eigen::Vector2d noise_ = Eigen::Vector2d::Ones();  // gyroscope, wheels
};

}  // namespace urban_nav_core
