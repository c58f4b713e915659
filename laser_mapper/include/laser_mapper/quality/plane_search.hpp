// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/quality/plane_constraints.hpp"

namespace laser_mapper {

/// Finds what planes that were seen in two passes tell of the robot's poses (plane_constraints.hpp), from the scans of
/// sessions that lie in one map. `drifts`: of their odometry, in the same order; null: none. Only stretches whose
/// places were passed more than once are rendered, from scans 30 ms apart, in a temporary store at `scratch_path`,
/// which is removed in the end; `store` is not changed. The result depends on scans, extrinsics, adopted calibrations
/// and trajectories alone, not on the number of threads. Throws the errors of the store.
std::vector<PlaneConstraint> searchPlaneConstraints(const Parameters& parameters, urban_nav_store::Store& store,
                                                    const std::vector<MappedSession>& sessions,
                                                    const std::vector<const OdometryDrift*>& drifts,
                                                    const std::string& scratch_path);

}  // namespace laser_mapper
