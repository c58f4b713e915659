// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage that fuses visual odometry with that of a 3D LiDAR (urban_nav_core::fuseOdometry) in sessions that
/// have both (chooseOdometry). It runs after stages vo and lo; it replaces MapSession::odometry and the nodes in the
/// store by the fused chain, at the times of the stereo frames.
std::unique_ptr<Stage> makeFusionStage();

}  // namespace urban_nav
