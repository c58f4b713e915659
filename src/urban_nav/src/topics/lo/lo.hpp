// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage lo: odometry by a 3D LiDAR (laser_odometry), for sessions with laser odometry (chooseOdometry). It
/// runs after stage vo, and sets MapSession::odometry and the trajectories of odometry.
std::unique_ptr<Stage> makeLoStage();

}  // namespace urban_nav
