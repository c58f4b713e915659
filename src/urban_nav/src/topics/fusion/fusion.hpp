// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "map/stage.hpp"

namespace urban_nav {

/// Returns the stage that fuses visual odometry with that of a 3D LiDAR (urban_nav_core::fuseOdometry) in sessions that
/// have both (chooseOdometry). It comes after stages vo and lo; MapSession::odometry is then the fused chain, at the
/// times of the stereo frames, and the store holds its nodes in place of those by stereo.
std::unique_ptr<Stage> makeFusionStage();

}  // namespace urban_nav
