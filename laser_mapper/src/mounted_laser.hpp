// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/store.hpp"

namespace laser_mapper {

/// A laser with the calibration that its session has adopted.
struct MountedLaser {
  std::string frame;
  urban_nav_core::Pose T_base_laser;
  urban_nav_core::StampNs delay = 0;  ///< its stamps are late by this
};

/// Returns the lasers of a session that have scans and extrinsics, by their frames; as the extrinsics state them.
std::vector<MountedLaser> statedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Returns the same lasers with the session's adopted calibration, if it has one. Throws DataError if that is damaged.
std::vector<MountedLaser> mountedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace laser_mapper
