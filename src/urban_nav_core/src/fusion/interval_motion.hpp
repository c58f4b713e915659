// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Sensitivity of a motion to a constant; the value used enters multiplied by it, since steps differ in the value.
struct ConstantShare {
  std::string name;
  Vector6d sensitivity = Vector6d::Zero();
  Vector6d used = Vector6d::Zero();  ///< sum of sensitivity times value used
};

/// Motion of base_link between any two times of an odometry.
struct IntervalMotion {
  Pose T_from_to;
  Matrix6d covariance = Matrix6d::Zero();  ///< drift, and the errors of both ends
  Matrix6d drift = Matrix6d::Zero();       ///< the part that adds up over consecutive intervals
  std::vector<ConstantShare> constants;
  bool is_lost = false;  ///< contains a step that was not measured
};

/// Motion and covariance between any two times of a chain of steps. Drift grows evenly within a step; a time within a
/// step is interpolated, with the error of unknown accelerations.
class InterpolatedOdometry {
 public:
  /// `steps`: in order of time, contiguous. They must outlive this object. Accelerations: m/s^2 and rad/s^2, one sigma.
  InterpolatedOdometry(const std::vector<RelativePose>& steps, double acceleration, double angular_acceleration);

  /// Requires from < to. Returns nullopt outside the chain, and if an end is within a step longer than 1 s.
  std::optional<IntervalMotion> over(StampNs from, StampNs to) const;

 private:
  /// A time as a step and a share of it, 0...1.
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
