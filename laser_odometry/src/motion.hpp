// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "laser_odometry/parameters.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

/// Motion of base_link at nearly constant velocity. Twists: SE(3) tangent in base_link, m/s and rad/s.
class MotionModel {
 public:
  explicit MotionModel(const Parameters& parameters) : parameters_(parameters) {}

  /// Returns whether a velocity was observed.
  bool isKnown() const { return known_; }
  /// Returns T_from_to after `seconds`.
  Pose predict(double seconds) const;
  /// Returns the covariance of predict(), tangent as in PoseWithCovariance.
  Matrix6d predictionCovariance(double seconds) const;
  /// Returns the velocity in the middle of a sweep, for a previous step `T_from_to` of `seconds`: mean of the step plus
  /// half of the change from the step before.
  Vector6d sweepTwist(const Pose& T_from_to, double seconds) const;
  /// Returns the velocity at the newest sweep.
  const Vector6d& twist() const { return twist_; }

  /// Updates with an estimated step. `observed`: all directions were observed.
  void update(const Pose& T_from_to, double seconds, bool observed);

  void archive(urban_nav_core::Archive& archive);

 private:
  Parameters parameters_;
  bool known_ = false;
  bool has_step_ = false;
  Vector6d step_twist_ = Vector6d::Zero();  ///< mean of the last step
  Vector6d twist_ = Vector6d::Zero();
  double unobserved_s_ = 0.0;  ///< since the velocity was observed
};

}  // namespace laser_odometry
