// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "base/console.hpp"
#include "base/parameter_set.hpp"
#include "map/stage.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav {

/// Returns the stage lo: odometry by a 3D LiDAR (laser_odometry), for sessions with laser odometry (chooseOdometry). It
/// runs after stage vo, and sets MapSession::odometry and the trajectories of odometry.
std::unique_ptr<Stage> makeLoStage();

/// Returns the poses of base_link in `odom` by the sweeps of a recording; empty if no sweep could be used.
/// `parameters`: with the table of laser_odometry. Shows its progress. Throws DataError if the recording cannot be
/// read.
urban_nav_core::Trajectory runLaserOdometry(urban_nav_input::Source& source, const ParameterSet& parameters,
                                            Console& console);

}  // namespace urban_nav
