// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "base/console.hpp"
#include "base/parameter_set.hpp"
#include "map/stage.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav {

/// Returns the stage vo: visual odometry by the sliding window filter (swf_vo). Always enabled, and first: it sets the
/// odometry of each item, MapSession::odometry, and the trajectories of odometry.
std::unique_ptr<Stage> makeVoStage();

/// Returns the smoothed poses of base_link in `odom` by the visual odometry of a recording; empty if no frame could be
/// used. `parameters`: with the table of swf_vo. Shows its progress. Throws DataError if the recording cannot be read.
urban_nav_core::Trajectory runOdometry(urban_nav_input::Source& source, const ParameterSet& parameters,
                                       Console& console);

}  // namespace urban_nav
