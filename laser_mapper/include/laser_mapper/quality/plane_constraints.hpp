// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "laser_mapper/quality/odometry_drift.hpp"
#include "laser_mapper/quality/plane_place.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace laser_mapper {

/// Duration of the intervals of a session whose planes form one constraint, counted from the first pose of the session.
constexpr urban_nav_core::StampNs kPlaneGroupTime = 4'000'000'000;

/// Constraint between the robot's poses in two passes, from planes observed in both (Newman et al. 2009, section 6.3).
struct PlaneConstraint {
  std::size_t session_a = 0, session_b = 0;          ///< indices, as in PlanePatch
  urban_nav_core::StampNs stamp_a = 0, stamp_b = 0;  ///< of poses of the trajectories
  /// T_a_b of base_link. The information is zero in unobserved directions: along a single plane and about its normal.
  urban_nav_core::Constraint measured;
  /// Indices of the intervals of kPlaneGroupTime in which the planes were observed.
  std::int64_t stretch_a = 0, stretch_b = 0;
  std::size_t planes = 0;  ///< number of planes, at least 3
  bool is_shared = false;  ///< ICP closures use some of its beams, and their part of its information was subtracted
};

/// Returns the constraints between the passes of a map rendered along `T_map_base`, one trajectory per session index,
/// sorted by session and stamp. Planes of the same 4 s of both passes form one constraint; planes that contradict the
/// others are rejected, as are groups with fewer than 3. A plane observed in n passes has a total weight of n - 1, not
/// one per pair. `range_bias`: standard deviation of a laser's constant error, m. `drifts`: drift within the intervals
/// according to odometry, one per session index, which enters the covariance of all planes of an interval; null: none.
/// Thread-safe.
std::vector<PlaneConstraint> findPlaneConstraints(const std::vector<PlanePlace>& places,
                                                  const std::vector<const urban_nav_core::Trajectory*>& T_map_base,
                                                  double range_bias, const std::vector<const OdometryDrift*>& drifts);

}  // namespace laser_mapper
