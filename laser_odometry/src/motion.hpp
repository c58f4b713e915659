// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laser_odometry/parameters.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

/// Returns the projector onto the span of twists, which may depend on each other. Rotations: 1 rad as 1 m. Directions
/// within 0.05 rad of each other are the same.
Matrix6d projectorOnto(const std::vector<Vector6d>& directions);

/// Accuracy of a measured step of base_link.
struct StepEvidence {
  Matrix6d covariance = Matrix6d::Zero();  ///< tangent as in PoseWithCovariance
  std::vector<Vector6d> free;              ///< directions of the tangent that its end does not measure
};

/// Motion of base_link at nearly constant velocity. Twists: SE(3) tangent in base_link, m/s and rad/s.
///
/// Along a direction that is free at either end of a step, the velocity is not measured by that step: a pose that is
/// measured again after a gap contains the error of the gap. It remains that of the last measurement, with an
/// uncertainty that grows by accelerations of a vehicle (docs/derivations/laser_odometry.md).
class MotionModel {
 public:
  explicit MotionModel(const Parameters& parameters) : parameters_(parameters) {}

  /// Returns whether a velocity was observed.
  bool isKnown() const { return known_; }
  /// Returns T_from_to after `seconds`.
  Pose predict(double seconds) const;
  /// Returns the covariance of predict(), tangent as in PoseWithCovariance. Errors of consecutive predictions are
  /// correlated: it is the growth of the variance of the whole motion since the velocity was measured, so that the sum
  /// over the steps is that variance.
  Matrix6d predictionCovariance(double seconds) const;
  /// Returns the covariance of one step of predict() by itself: less than predictionCovariance() within a gap.
  Matrix6d stepCovariance(double seconds) const;
  /// Returns the time since all directions of the velocity were measured, s.
  double unobservedSeconds() const { return unobserved_s_; }
  /// Returns the velocity in the middle of a sweep, for a previous step `T_from_to` of `seconds`: mean of the step plus
  /// half of the change from the step before, if that was measured; of predict() along directions that were free at the
  /// beginning of the step.
  Vector6d sweepTwist(const Pose& T_from_to, double seconds) const;
  /// Returns the velocity at the newest sweep.
  const Vector6d& twist() const { return twist_; }

  /// Updates with an estimated step.
  void update(const Pose& T_from_to, double seconds, const StepEvidence& evidence);

  void archive(urban_nav_core::Archive& archive);

 private:
  Parameters parameters_;
  bool known_ = false;
  bool has_step_ = false;
  Vector6d step_twist_ = Vector6d::Zero();  ///< mean of the last step
  Vector6d twist_ = Vector6d::Zero();
  Matrix6d twist_covariance_ = Matrix6d::Zero();  ///< when twist_ was measured
  std::vector<Vector6d> free_;                    ///< directions that the last pose left free
  Matrix6d unmeasured_ = Matrix6d::Zero();        ///< projector onto directions that the last step did not measure
  double fastest_ = 0.0;                          ///< highest speed that was observed, m/s
  double unobserved_s_ = 0.0;                     ///< since the velocity was observed
};

}  // namespace laser_odometry
