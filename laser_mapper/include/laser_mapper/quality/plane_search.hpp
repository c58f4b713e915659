// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/quality/plane_constraints.hpp"

namespace laser_mapper {

/// Finds constraints from planes observed in two passes (plane_constraints.hpp) in the scans of sessions in one map.
/// `drifts`: of their odometry, in the same order; null: none. Renders only intervals whose places were visited more
/// than once, from scans 30 ms apart, in a temporary store at `scratch_path`, which is removed at the end; `store` is
/// not changed. The result depends only on scans, extrinsics, adopted calibrations and trajectories, not on the number
/// of threads. Throws the errors of the store.
std::vector<PlaneConstraint> searchPlaneConstraints(const Parameters& parameters, urban_nav_store::Store& store,
                                                    const std::vector<MappedSession>& sessions,
                                                    const std::vector<const OdometryDrift*>& drifts,
                                                    const std::string& scratch_path);

}  // namespace laser_mapper
