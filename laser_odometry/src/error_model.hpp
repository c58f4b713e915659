// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "registration.hpp"

namespace laser_odometry {

/// Errors of registered poses in units of the information of independent patches, as the residuals show them.
///
/// A residual has a part that changes from sweep to sweep and a part that a surface keeps as long as it is seen. The
/// first is the error of each pose, the second becomes drift as surfaces are replaced by others. Both are correlated
/// within a surface: sums of residuals over blocks of neighbouring patches of like orientation are compared, not single
/// residuals (docs/derivations/laser_odometry.md).
class ErrorModel {
 public:
  /// Observes the matches of a sweep and stores each cell's mean residual for the next one.
  void observe(const std::vector<PatchMatch>& matches, std::int32_t sweep);

  /// Factor on the inverse information: error of each pose, independent from sweep to sweep.
  double passing() const { return passing_; }
  /// Factor on the inverse information: error that the surfaces in view have in common.
  double lasting() const { return lasting_; }
  /// Mean age of the surfaces of the last sweep, sweeps; at least 1.
  double age() const { return age_; }

  /// Returns the least covariance of a pose: what beams have in common, such as angles of rings and quantised ranges.
  static Matrix6d endFloor();
  /// Returns the least covariance that a step of a length (m) adds: range scale and angles of rings.
  static Matrix6d driftFloor(double length);

  void archive(urban_nav_core::Archive& archive);

 private:
  double passing_ = 1.0, lasting_ = 1.0, age_ = 1.0;
  std::int32_t observed_ = 0;
};

}  // namespace laser_odometry
