// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_registration/session/session_lasers.hpp"

namespace laser_mapper {

using MountedLaser = urban_nav_registration::LaserAt;

/// Return the lasers of a session in the order of their frames: with the extrinsics, or with the adopted calibration of
/// the session, if any. Throw DataError if the calibration is damaged.
std::vector<MountedLaser> statedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
std::vector<MountedLaser> mountedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace laser_mapper
