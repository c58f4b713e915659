// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segway_drivers/camera/sim_source.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

/// Simulates a session of the robot with one camera and returns its raw frames while rendering. Throws UserError for
/// an unknown world or route.
segway_drivers::FrameReader simulateFrames(urban_nav_sim::SessionOptions options,
                                           segway_drivers::SimCameraOptions::Model model);

}  // namespace urban_nav
