// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "registration.hpp"

namespace laser_odometry {

/// Errors of registered poses, estimated from residuals, in units of the information of independent patches.
///
/// A residual has a part that changes from sweep to sweep and a part constant for a surface. The first is the error of
/// each pose, the second becomes drift as surfaces leave the view. Both are correlated within a surface: therefore sums
/// of residuals over blocks of neighbouring patches of similar orientation are compared, not single residuals
/// (docs/derivations/laser_odometry.md).
class ErrorModel {
 public:
  /// `space`: of the motions.
  explicit ErrorModel(MotionSpace space = MotionSpace::Spatial) : space_(space) {}

  /// Observes the matches of a sweep and stores each cell's mean residual for the next one.
  void observe(const std::vector<PatchMatch>& matches, std::int32_t sweep);

  /// Factor on the inverse information: error of each pose, independent from sweep to sweep.
  double passing() const { return passing_; }
  /// Factor on the inverse information: error common to the surfaces in view.
  double lasting() const { return lasting_; }
  /// Mean age of the surfaces of the last sweep, sweeps; at least 1.
  double age() const { return age_; }

  /// Returns the minimum covariance of a pose: errors common to beams, such as angles of rings and quantised ranges.
  static Matrix6d endFloor();
  /// Returns the minimum covariance added by a step of a length (m): range scale and angles of rings.
  static Matrix6d driftFloor(double length);

  void archive(urban_nav_core::Archive& archive);

 private:
  MotionSpace space_;
  double passing_ = 1.0, lasting_ = 1.0, age_ = 1.0;
  std::int32_t observed_ = 0;
};

}  // namespace laser_odometry
