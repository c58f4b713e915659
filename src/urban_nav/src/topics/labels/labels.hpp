// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "base/command.hpp"
#include "base/console.hpp"
#include "base/parameter_set.hpp"
#include "map/stage.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav {

/// Returns the stage that labels the points of the lasers' map with classes.
std::unique_ptr<Stage> makeLabelsStage();

/// Returns the odometry of a recording, by its images or, without any, by its sweeps: poses of base_link; empty if none
/// could be used.
using OdometryRunner =
    std::function<urban_nav_core::Trajectory(urban_nav_input::Source&, const ParameterSet&, Console&)>;

/// Returns the command labels with its actions. `run_odometry`: for bags without a trajectory.
Command labelsCommand(const OdometryRunner& run_odometry);

}  // namespace urban_nav
