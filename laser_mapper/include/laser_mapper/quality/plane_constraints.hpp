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

/// Duration of the stretches of a session whose planes make one constraint. They are counted from the first pose of the
/// session.
constexpr urban_nav_core::StampNs kPlaneGroupTime = 4'000'000'000;

/// What planes that were seen in two passes tell of the robot's poses there (Newman et al. 2009, section 6.3).
struct PlaneConstraint {
  std::size_t session_a = 0, session_b = 0;          ///< indices, as in PlanePatch
  urban_nav_core::StampNs stamp_a = 0, stamp_b = 0;  ///< of poses of the trajectories
  /// T_a_b of base_link. The information is zero in the directions that the planes do not tell: along a single plane
  /// and about its normal.
  urban_nav_core::Constraint measured;
  /// Numbers of the stretches of kPlaneGroupTime that the planes were seen in.
  std::int64_t stretch_a = 0, stretch_b = 0;
  std::size_t planes = 0;  ///< that it rests on, at least 3
  bool is_shared = false;  ///< closures by ICP rest on some of its beams, and have taken their part of its information
};

/// Returns the constraints between the passes of a map that was rendered along `T_map_base`, one trajectory per session
/// index, sorted by session and stamp. Planes of the same 4 s of both passes make one constraint; planes that
/// contradict the others are left out, and so is a group with fewer than 3. A plane seen in n passes counts n - 1 times
/// in total, not once per pair. `range_bias`: standard deviation of a laser's constant error, m. `drifts`: what
/// odometry states of the drift within the stretches, one per session index; null: none. It is part of the covariance
/// of all planes of a stretch. Thread-safe.
std::vector<PlaneConstraint> findPlaneConstraints(const std::vector<PlanePlace>& places,
                                                  const std::vector<const urban_nav_core::Trajectory*>& T_map_base,
                                                  double range_bias, const std::vector<const OdometryDrift*>& drifts);

}  // namespace laser_mapper
