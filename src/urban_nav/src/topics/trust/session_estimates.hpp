// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "map/session_odometry.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_trust/session_comparisons.hpp"

namespace urban_nav {

/// Compares the vertical by the ground planes of dense stereo with that by the accelerometer, along the odometry of a
/// session, and adds the test or the reason for its absence. Throws DataError if the store is damaged.
void compareGravity(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                    const SessionOdometry& odometry, urban_nav_trust::TestResults& results);

/// Returns the comparison of stereo and LiDAR odometry by the fusion of a session; nullopt without one.
std::optional<urban_nav_trust::LidarComparison> lidarComparison(const SessionOdometry& odometry);

}  // namespace urban_nav
