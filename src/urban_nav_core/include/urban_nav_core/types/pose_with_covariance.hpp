// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/container/small_vector.hpp>
#include <iosfwd>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_core/types/status.hpp"

namespace urban_nav_core {

/// A pose T_a_b and its 6x6 covariance.
///
/// WARNING, the convention of everything that leaves a stage: tangent (rho, phi), translation first, both in the
/// parent frame a: T_a_b = [Exp(phi) R, t + rho]. It is ROS's convention to first order. Proper (positive definite):
/// a direction that is not observed belongs into a Constraint, as zero information.
struct PoseWithCovariance {
  Pose pose;
  Matrix6d covariance = Matrix6d::Identity();
};

/// A constant of the rig whose error all steps of its sessions share: a consider state (Schmidt 1966), which no later
/// stage estimates and every later covariance contains. The error of a step is sensitivity (used - true value).
struct ConsideredConstant {
  std::string name;                         ///< "disparity" (px), "scale" (relative); the same in all sessions
  double used = 0.0;                        ///< value with which the step was estimated
  double mean = 0.0, sigma = 0.0;           ///< of the true value, by what was known when the step was final
  Vector6d sensitivity = Vector6d::Zero();  ///< change of T_from_to per unit, tangent as in PoseWithCovariance
};

/// Constants of one step, one entry for each name. Up to two need no heap memory, so that an odometry allocates
/// nothing for a frame.
using ConsideredConstants = boost::container::small_vector<ConsideredConstant, 2>;

/// Motion of one frame between two times, as an odometry gives it: T_from_to takes coordinates at `to` to coordinates
/// at `from`.
struct RelativePose {
  StampNs from = 0;
  StampNs to = 0;
  Pose T_from_to;
  Matrix6d covariance = Matrix6d::Identity();  ///< as in PoseWithCovariance, parent frame: `from`
  /// WARNING: covariances of an odometry's steps are right one by one, but neighbours share an end: composed as if
  /// independent they may be 5 to 50 times too large over 100 steps. This is the part that adds up. The covariance of a
  /// way of many steps is that composed of their drifts, with half of `covariance` added to the first and to the last.
  /// Zero where the odometry does not tell it apart: then `covariance` adds up.
  Matrix6d drift_covariance = Matrix6d::Zero();
  Status status;
  std::string source;  ///< which odometry ("swf_vo")
  /// Errors that all steps share. They are not in `drift_covariance`.
  ConsideredConstants constants{};
};

/// A measured T_a_b that may leave directions free: what a closure or a plane seen again says.
///
/// WARNING: `information` may be singular and must never be inverted. Tangent and frame as in PoseWithCovariance; a
/// direction that is not observed has zero information, not a small one.
struct Constraint {
  Pose T_a_b;
  Matrix6d information = Matrix6d::Zero();
};

bool isFinite(const ConsideredConstant& constant);

/// Poses equal within `tolerance` (m, rad), every element of the matrices within `tolerance`; stamps, status and source
/// exactly.
bool isApprox(const PoseWithCovariance& a, const PoseWithCovariance& b, double tolerance);
bool isApprox(const ConsideredConstant& a, const ConsideredConstant& b, double tolerance);
bool isApprox(const RelativePose& a, const RelativePose& b, double tolerance);
bool isApprox(const Constraint& a, const Constraint& b, double tolerance);
/// The pose with the standard deviations of its six coordinates.
std::ostream& operator<<(std::ostream& out, const PoseWithCovariance& value);
std::ostream& operator<<(std::ostream& out, const RelativePose& value);
std::ostream& operator<<(std::ostream& out, const Constraint& value);

}  // namespace urban_nav_core
