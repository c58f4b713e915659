// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_registration/cloud/local_cloud.hpp"
#include "urban_nav_store/scan_store.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_registration {

/// A laser of a session.
struct LaserAt {
  std::string frame;  ///< frame of its stored scans
  urban_nav_core::Pose T_base_laser;
  urban_nav_core::StampNs delay = 0;  ///< delay of its stamps
  bool is_lidar = false;              ///< a 3D LiDAR, whose stored scans are the rings of its sweeps
};

/// Returns the lasers of a session that have scans and extrinsics in the store, with the stated extrinsics.
std::vector<LaserAt> statedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Returns these lasers with the calibration adopted by the session, if any (adopted_calibration.hpp). Throws DataError
/// if it is damaged.
std::vector<LaserAt> storedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Returns a scan with its stamps corrected for a delay of `delay`.
urban_nav_core::Scan withoutDelay(urban_nav_core::Scan scan, urban_nav_core::StampNs delay);

/// Returns readers of the lasers' stored scans for localCloud(); stamps are corrected for the delays. `scans` must
/// outlive them.
std::vector<LaserScans> storedScans(const urban_nav_store::ScanStore& scans, const urban_nav_store::SessionId& session,
                                    const std::vector<LaserAt>& lasers);

}  // namespace urban_nav_registration
