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
};

/// Returns the lasers of a session that have scans and extrinsics in the store.
std::vector<LaserAt> storedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Returns readers of the lasers' stored scans, as localCloud() takes them. `scans` must outlive them.
std::vector<LaserScans> storedScans(const urban_nav_store::ScanStore& scans, const urban_nav_store::SessionId& session,
                                    const std::vector<LaserAt>& lasers);

}  // namespace urban_nav_registration
