// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "laser_mapper/calibration/view_calibration.hpp"
#include "laser_mapper/colour/colouriser.hpp"
#include "laser_mapper/laser_map.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

constexpr double kViewDistance = 0.7, kViewAngle = 0.26;  ///< m, rad: between views of one camera

/// Returns the colouriser of a map from stored panoramas of its sessions, about 0.7 m or 15 deg apart; null if there
/// are none within the time of the trajectories. The store must outlive it. `memory_mb`: for decoded images.
std::unique_ptr<laser_mapper::Colouriser> makeColouriser(urban_nav_store::Store& store,
                                                         const std::vector<laser_mapper::MappedSession>& sessions,
                                                         double voxel, double memory_mb);

/// Calibrates the panoramic head of a session by the colours of its map; nullopt if there are no panoramas within the
/// time of the trajectory. `odometry`: see laser_mapper::ViewCalibrator.
std::optional<laser_mapper::ViewCalibration> calibratePanoramas(urban_nav_store::Store& store,
                                                                const laser_mapper::MappedSession& session,
                                                                const urban_nav_core::OdometryChain& odometry,
                                                                const laser_mapper::LaserMap& map);

}  // namespace urban_nav
