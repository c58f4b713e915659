// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav::bench {

/// Writes the scans of a simulated bag and the extrinsics of its lasers to a store, as a session. Commits.
void putLaserSession(const std::string& bag, const urban_nav_store::SessionId& id, const std::string& name,
                     urban_nav_store::Store& store);

/// Returns the true poses of base_link, from BAG_STEM.truth/trajectory.tum.
urban_nav_core::Trajectory trueTrajectory(const std::string& bag);

}  // namespace urban_nav::bench
