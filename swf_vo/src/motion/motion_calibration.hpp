// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Step between two frames as images alone measure it. Of its error one part adds up over steps, and one belongs to
/// the place of a frame: the next step takes it back.
struct ImageStep {
  double seconds = 0.0;
  urban_nav_core::Vector3d rotation = urban_nav_core::Vector3d::Zero();  ///< rotation vector of R_from_to of base_link
  double forward = 0.0;                                                  ///< m, along x of base_link at `from`
  double rotation_drift = 0.0, rotation_end = 0.0;                       ///< variances about an axis, rad^2
  double forward_drift = 0.0, forward_end = 0.0;                         ///< variances, m^2
};

/// Difference between a step by images and by a gyroscope, in the axes of base_link at its end: error = images -
/// gyroscope = bias d(bias) + offset d(offset) + noise, d being true - estimated.
struct GyroscopeStep {
  urban_nav_core::Vector3d error = urban_nav_core::Vector3d::Zero();   ///< rad
  urban_nav_core::Matrix3d bias = urban_nav_core::Matrix3d::Zero();    ///< s
  urban_nav_core::Vector3d offset = urban_nav_core::Vector3d::Zero();  ///< rad/s
  double variance = 0.0;                                               ///< of the noise about an axis, rad^2
};

/// Difference between a step by images and by wheels, as in GyroscopeStep: first along x (m), then about z (rad).
struct WheelStep {
  struct Part {
    double error = 0.0, scale = 0.0, offset = 0.0, variance = 0.0;
  };
  Part forward, turn;
};

/// Slow states of motion sensors and their covariance.
struct MotionStates {
  static constexpr int kBias = 0, kImuOffset = 3, kSpeedScale = 4, kTurnScale = 5, kWheelOffset = 6, kSize = 7;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  /// Bias of the gyroscope (rad/s, in base_link); seconds by which its stamps are late; measured over true speed and
  /// yaw rate of the wheels, less 1; seconds by which their stamps are late.
  Vector mean = Vector::Zero();
  Matrix covariance = Matrix::Identity();

  urban_nav_core::Vector3d bias() const { return mean.segment<3>(kBias); }
};

/// Standard deviations before anything is known.
constexpr double kBiasPrior = 0.1;         ///< rad/s
constexpr double kOffsetPrior = 0.05;      ///< s
constexpr double kSpeedScalePrior = 0.05;  ///< relative
constexpr double kTurnScalePrior = 0.2;    ///< relative: tracks and tyres scrub

/// Estimates bias, scales and time offsets of motion sensors from steps that images alone have measured: an extended
/// Kalman filter whose states are random walks. What two successive steps share, the place of the frame between them,
/// is a state too, so that the errors of images and of encoders add up as they do, and no faster. These images are
/// independent of the sensors, so nothing is counted twice (docs/derivations/motion_sensors.md). Not thread-safe.
class MotionCalibration {
 public:
  MotionCalibration();

  /// Takes a step. `follows`: it begins where the step before ended.
  void update(const ImageStep& images, bool follows, const std::optional<GyroscopeStep>& gyroscope,
              const std::optional<WheelStep>& wheels);
  /// Lets time pass, s.
  void advance(double seconds);
  /// Forgets what is known of one sensor.
  void forgetGyroscope();
  void forgetWheels();

  const MotionStates& states() const { return states_; }
  /// Returns the variance of the noise of a sensor, over what is stated of it.
  double gyroscopeNoise() const { return noise_[0]; }
  double wheelNoise() const { return noise_[1]; }

  void archive(urban_nav_core::Archive& archive);

 private:
  static constexpr int kEnds = 5;  // of a frame: rotation, forward, and yaw as the wheels have it
  static constexpr int kAll = MotionStates::kSize + 2 * kEnds;
  using Row = Eigen::Matrix<double, kAll, 1>;
  using Joint = Eigen::Matrix<double, kAll, kAll>;

  void beginStep(const ImageStep& images, bool follows);
  void measure(const Row& row, double error, double variance, int sensor);
  void endStep();
  void forget(int first, int count);
  void restorePrior(int state);

  MotionStates states_;
  Joint P_ = Joint::Zero();                          // states, ends of the frame before, ends of this frame
  Row change_ = Row::Zero();                         // of the estimates of a step; ends are zero before
  Eigen::Vector2d noise_ = Eigen::Vector2d::Ones();  // gyroscope, wheels
};

}  // namespace swf_vo
