// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "registration.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace laser_odometry {

/// Returns the free directions as twists in base_link.
std::vector<Vector6d> freeTwists(const FreeSubspace& free, const Matrix3d& R_base_odom);

/// Error of the pose along directions that nothing has measured since a sweep. Where such a direction is measured
/// again, surfaces of the map from before the gap take the error back: the step contains it with the opposite sign.
/// Surfaces that were mapped within the gap share the error of the pose, which stays.
class GapError {
 public:
  /// Adds the covariance of a step along a number of free directions, axes of odom; `sweep`: the number of its end.
  void extend(const Matrix6d& along_free, std::int32_t directions, std::int32_t sweep);
  /// Returns the mean of the free directions of a registration and those before it in this gap. Errors of a gap lie
  /// along one direction, while each registration estimates it with noise. Call once for each registration.
  FreeSubspace average(const FreeSubspace& free);
  /// Ends the gap along the directions that a registration measures. Returns the covariance of the error that the
  /// registration takes back, axes of odom; zero if its surfaces are those of the gap.
  Matrix6d close(const Registration& registration);

  void archive(urban_nav_core::Archive& archive) { archive(covariance_, projectors_, directions_, begin_); }

 private:
  Matrix6d covariance_ = Matrix6d::Zero();
  Matrix6d projectors_ = Matrix6d::Zero();  ///< sum over the registrations of the gap, onto scaled free directions
  std::int32_t directions_ = 0;             ///< number of free ones at the last pose
  std::int32_t begin_ = 0;                  ///< last sweep before the gap
};

}  // namespace laser_odometry
