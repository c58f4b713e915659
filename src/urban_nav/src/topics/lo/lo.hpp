// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage lo: odometry by a 3D LiDAR (laser_odometry), of sessions whose odometry is that of the laser
/// (chooseOdometry). It comes after stage vo, and sets MapSession::odometry and the trajectories of odometry.
std::unique_ptr<Stage> makeLoStage();

}  // namespace urban_nav
