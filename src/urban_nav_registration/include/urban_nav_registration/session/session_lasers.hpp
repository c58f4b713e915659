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
  std::string frame;  ///< under which its scans are stored
  urban_nav_core::Pose T_base_laser;
  urban_nav_core::StampNs delay = 0;  ///< its stamps are late by this
};

/// Returns the lasers of a session that have scans and extrinsics in the store, as the extrinsics state them.
std::vector<LaserAt> statedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Returns the same lasers with the calibration that the session has adopted, if any (adopted_calibration.hpp). Throws
/// DataError if that is damaged.
std::vector<LaserAt> storedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Returns a scan with the times at which its beams were measured, if its stamps are late by `delay`.
urban_nav_core::Scan withoutDelay(urban_nav_core::Scan scan, urban_nav_core::StampNs delay);

/// Returns readers of the lasers' stored scans, as localCloud() takes them; stamps are without the lasers' delays.
/// `scans` must outlive them.
std::vector<LaserScans> storedScans(const urban_nav_store::ScanStore& scans, const urban_nav_store::SessionId& session,
                                    const std::vector<LaserAt>& lasers);

}  // namespace urban_nav_registration
