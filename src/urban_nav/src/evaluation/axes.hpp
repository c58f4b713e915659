// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/trajectory/associate.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav {

/// Which of two trajectories has the axes of a camera (z forward, x right) while the other has those of a body
/// (x forward, z up).
enum class Axes { Same, EstimateOptical, TruthOptical };

/// Detects that the poses agree much better (a tenth of the error, and under a fifth of the path) once one of both is
/// turned from optical to body axes. Same for anything less clear.
Axes detectAxes(const urban_nav_core::Matched& matched);

/// Turns the poses of the one with optical axes.
void applyAxes(Axes axes, urban_nav_core::Matched& matched);
/// The covariance of an estimate's pose after that, in the axes of its first pose.
urban_nav_core::Matrix6d applyAxes(Axes axes, const urban_nav_core::Matrix6d& covariance);

/// "" for Same, else what was found and done, for the user.
const char* describe(Axes axes);

}  // namespace urban_nav
