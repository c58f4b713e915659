// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_registration/session/session_lasers.hpp"

namespace laser_mapper {

using MountedLaser = urban_nav_registration::LaserAt;

/// Return the lasers of a session in the order of their frames: as the extrinsics state them; with the calibration that
/// the session has adopted, if it has one. Throw DataError if that is damaged.
std::vector<MountedLaser> statedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
std::vector<MountedLaser> mountedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace laser_mapper
