// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/container/small_vector.hpp>
#include <iosfwd>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_core/types/status.hpp"

namespace urban_nav_core {

/// Pose T_a_b and its 6x6 covariance.
///
/// WARNING: the convention of all outputs of stages: tangent (rho, phi), translation first, both in the parent frame a:
/// T_a_b = [Exp(phi) R, t + rho]. To first order this is the convention of ROS. The covariance is positive definite; an
/// unobserved direction requires a Constraint, as zero information.
struct PoseWithCovariance {
  Pose pose;
  Matrix6d covariance = Matrix6d::Identity();
};

/// Constant of the rig whose error is common to all steps of its sessions: a consider state (Schmidt 1966), which no
/// later stage estimates and every later covariance includes. The error of a step is sensitivity (used - true value).
struct ConsideredConstant {
  std::string name;                         ///< "disparity" (px), "scale" (relative); equal in all sessions
  double used = 0.0;                        ///< value with which the step was estimated
  double mean = 0.0, sigma = 0.0;           ///< of the true value, known when the step became final
  Vector6d sensitivity = Vector6d::Zero();  ///< change of T_from_to per unit, tangent as in PoseWithCovariance
};

/// Constants of one step, one entry per name. Up to two are stored without heap allocation, so that odometry does not
/// allocate per frame.
using ConsideredConstants = boost::container::small_vector<ConsideredConstant, 2>;

/// Motion of a body frame between two times, the output of odometry: T_from_to takes coordinates at `to` to coordinates
/// at `from`.
struct RelativePose {
  StampNs from = 0;
  StampNs to = 0;
  Pose T_from_to;
  Matrix6d covariance = Matrix6d::Identity();  ///< as in PoseWithCovariance, parent frame: `from`
  /// Part of the covariance that adds up over steps.
  ///
  /// WARNING: covariances of consecutive steps are each correct, but neighbours share an end pose: composed as if
  /// independent, the result may be 5 to 50 times too large over 100 steps. The covariance of a path of many steps is
  /// composed of their drift covariances, with half of `covariance` added to the first and to the last. Zero if the
  /// odometry does not provide it: then `covariance` is composed.
  Matrix6d drift_covariance = Matrix6d::Zero();
  Status status;
  std::string source;  ///< odometry ("swf_vo")
  /// Errors common to all steps, not included in `drift_covariance`.
  ConsideredConstants constants{};
};

/// Measured T_a_b that may have unobserved directions, from a closure or a re-observed plane.
///
/// WARNING: `information` may be singular and must never be inverted. Tangent and frame as in PoseWithCovariance; an
/// unobserved direction has zero information, not small information.
struct Constraint {
  Pose T_a_b;
  Matrix6d information = Matrix6d::Zero();
};

bool isFinite(const ConsideredConstant& constant);

/// Returns whether poses agree within `tolerance` (m, rad) and all matrix elements within `tolerance`; stamps, status
/// and source must be equal.
bool isApprox(const PoseWithCovariance& a, const PoseWithCovariance& b, double tolerance);
bool isApprox(const ConsideredConstant& a, const ConsideredConstant& b, double tolerance);
bool isApprox(const RelativePose& a, const RelativePose& b, double tolerance);
bool isApprox(const Constraint& a, const Constraint& b, double tolerance);
/// Prints the pose with the standard deviations of its six coordinates.
std::ostream& operator<<(std::ostream& out, const PoseWithCovariance& value);
std::ostream& operator<<(std::ostream& out, const RelativePose& value);
std::ostream& operator<<(std::ostream& out, const Constraint& value);

}  // namespace urban_nav_core
