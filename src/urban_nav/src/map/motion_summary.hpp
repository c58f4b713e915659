// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "urban_nav_core/motion/motion_estimates.hpp"

namespace urban_nav {

/// Adds the states of the motion sensors in use. `scale_sigma`: standard deviation of the relative scale error of the
/// odometry that they were compared with.
void addMotion(const urban_nav_core::MotionEstimates& motion, double scale_sigma, Json& json);

/// Appends the motion sensors that were excluded, with their causes. `begin`: stamp of the first frame of the input.
void addMotionFaults(const urban_nav_core::MotionEstimates& motion, const std::string& input,
                     urban_nav_core::StampNs begin, std::vector<std::string>& warnings);

/// Returns a table of the motion sensors: whether they are in use, their calibration, and why one is excluded; nullopt
/// without sensors.
std::optional<PageTable> motionTable(const urban_nav_core::MotionEstimates& motion);

}  // namespace urban_nav
