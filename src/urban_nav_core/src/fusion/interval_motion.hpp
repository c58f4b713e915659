// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Sensitivity of a motion to a constant, and its product with the value used, since steps differ in that value.
struct ConstantShare {
  std::string name;
  Vector6d sensitivity = Vector6d::Zero();
  Vector6d used = Vector6d::Zero();  ///< sum of sensitivity times value used
};

/// Motion of base_link between any two times of an odometry.
struct IntervalMotion {
  Pose T_from_to;
  Matrix6d covariance = Matrix6d::Zero();  ///< drift plus the errors of both end poses
  Matrix6d drift = Matrix6d::Zero();       ///< part that adds up over consecutive intervals
  std::vector<ConstantShare> constants;
  bool is_lost = false;  ///< contains a step without measurement
};

/// Motion and covariance between any two times of a chain of steps. Drift grows linearly within a step; poses within a
/// step are interpolated, with the error of unknown accelerations.
class InterpolatedOdometry {
 public:
  /// `steps`: in order of time, contiguous; must outlive this object. Accelerations: m/s^2 and rad/s^2, one sigma.
  InterpolatedOdometry(const std::vector<RelativePose>& steps, double acceleration, double angular_acceleration);

  /// Returns the motion; nullopt outside the chain, and if an end is within a step longer than 1 s. Requires from < to.
  std::optional<IntervalMotion> over(StampNs from, StampNs to) const;

 private:
  /// Time as index of a step and fraction of it, 0...1.
  struct Place {
    std::size_t step = 0;
    double share = 0.0;
  };
  std::optional<Place> find(StampNs stamp) const;
  Matrix6d endError(const Place& place) const;

  const std::vector<RelativePose>& steps_;
  double acceleration_, angular_acceleration_;
};

}  // namespace urban_nav_core
