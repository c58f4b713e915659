// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/motion/motion_calibration.hpp"
#include "urban_nav_core/motion/twist_stream.hpp"

namespace urban_nav_core {

/// Plane on which a vehicle drives, z = slope_x x + slope_y y in the axes of `odom`, and its covariance.
struct GroundSlope {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = 0.01 * Eigen::Matrix2d::Identity();  ///< standard deviation of 0.1 rad before any
                                                                    ///< measurement
  /// Updates with a step of base_link in the axes of `odom` (m), whose height has this variance (m^2).
  void learn(const Vector3d& step, double variance);
  /// Returns the slope with the prior that ground is level within some degrees. `up`: in `odom`, with the standard
  /// deviation of each tilt (rad).
  GroundSlope levelled(const Vector3d& up, double sigma) const;
  Vector3d normal() const { return Vector3d(-mean.x(), -mean.y(), 1.0).normalized(); }
  void archive(Archive& archive) { archive(mean, covariance); }
};

/// Inputs of dead reckoning. Null: the sensor is not used.
struct MotionEvidence {
  const TwistStream* gyroscope = nullptr;
  const TwistStream* wheels = nullptr;
  const MotionStates* states = nullptr;
  const GroundSlope* ground = nullptr;
  double gyroscope_noise = 1.0, wheel_noise = 1.0;  ///< factors on the variances stated by the streams
  /// Time before `from` without measurements other than dead reckoning, of the rotation and of the translation, s.
  double turn_unmeasured = 0.0, forward_unmeasured = 0.0;
};

/// Motion of base_link between two stamps from motion sensors only.
struct Reckoned {
  Pose T_from_to;
  /// Perturbation of boxPlus, in `from`. In a chain of steps without other measurements, errors common to all steps
  /// (bias, scales, slope) are distributed so that the sum over the steps is correct
  /// (docs/derivations/motion_sensors.md).
  Matrix6d covariance = Matrix6d::Zero();
  /// Covariance of this step by itself: without the growth of common errors over a chain.
  Matrix6d covariance_alone = Matrix6d::Zero();
  bool has_gyroscope = false;    ///< rotation by the gyroscope; false: yaw by wheels
  bool has_translation = false;  ///< false: translation and its rows of the covariance are undefined
};

/// Integrates gyroscope rates, wheel speeds, or both, between two stamps. Wheels are constrained to the ground: no
/// lateral slip and no motion out of the plane, each up to a small share of the distance. Without a gyroscope the yaw
/// rate of the wheels is used. Returns nullopt if neither is available, or if one of them leaves too much of the
/// interval uncovered. `q_odom_base`: at `from`.
std::optional<Reckoned> reckon(const MotionEvidence& evidence, StampNs from, StampNs to,
                               const Quaterniond& q_odom_base);

/// Returns the variance per second of the integrated gyroscope rate about an axis, rad^2/s: as stated by the span, else
/// estimated from the scatter of the stream.
double rateDensity(const TwistStream& gyroscope, const TwistSpan& span);

/// Returns the sensor's stamp of a time on the clock of the reference.
StampNs delayed(StampNs stamp, double offset_s);

}  // namespace urban_nav_core
