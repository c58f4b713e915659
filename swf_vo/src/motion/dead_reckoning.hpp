// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "motion/motion_calibration.hpp"
#include "motion/twist_stream.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Plane on which a vehicle drives, z = slope_x x + slope_y y in the axes of `odom`, and its covariance.
struct GroundSlope {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = 0.01 * Eigen::Matrix2d::Identity();  ///< of 0.1 rad before anything is known
  /// Takes a step of base_link in the axes of `odom` (m) whose height has this variance (m^2).
  void learn(const urban_nav_core::Vector3d& step, double variance);
  urban_nav_core::Vector3d normal() const { return urban_nav_core::Vector3d(-mean.x(), -mean.y(), 1.0).normalized(); }
  void archive(urban_nav_core::Archive& archive) { archive(mean, covariance); }
};

/// Inputs of dead reckoning. Null: no such sensor is to be used.
struct MotionEvidence {
  const TwistStream* gyroscope = nullptr;
  const TwistStream* wheels = nullptr;
  const MotionStates* states = nullptr;
  const GroundSlope* ground = nullptr;
  double gyroscope_noise = 1.0, wheel_noise = 1.0;  ///< factors of the variances that streams state
  double since_measured = 0.0;  ///< s before `from` in which nothing but dead reckoning was known already
};

/// Motion of base_link between two stamps by sensors of motion alone.
struct Reckoned {
  urban_nav_core::Pose T_from_to;
  /// Perturbation of boxPlus, in `from`. For a step of a chain that nothing else measures: what the steps share (bias,
  /// scales, slope) is divided among them so that the sum over them is right (docs/derivations/motion_sensors.md).
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Zero();
  bool has_translation = false;  ///< else translation and its rows of the covariance mean nothing
};

/// Integrates rates of a gyroscope, speeds of wheels, or both, from one stamp to another. Wheels follow the ground: no
/// sliding sideways, no climbing out of the plane, each up to a small share of the distance. Without a gyroscope the
/// wheels' yaw rate turns the robot. nullopt: neither is there, or one leaves too much of the time open. `q_odom_base`:
/// at `from`.
std::optional<Reckoned> reckon(const MotionEvidence& evidence, urban_nav_core::StampNs from, urban_nav_core::StampNs to,
                               const urban_nav_core::Quaterniond& q_odom_base);

/// Returns the variance per second of a gyroscope's integrated rate about an axis, rad^2/s: as stated by a span, else
/// as found from the scatter of the stream.
double rateDensity(const TwistStream& gyroscope, const TwistSpan& span);

/// Returns a stamp of a sensor for a time on the clock of the cameras.
urban_nav_core::StampNs delayed(urban_nav_core::StampNs stamp, double offset_s);

}  // namespace swf_vo
