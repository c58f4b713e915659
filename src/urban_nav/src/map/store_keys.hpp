// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/forces_state.hpp"

namespace urban_nav {

/// Keys of visual odometry in a session store: the source of its edges and of its finished state, its stream.
constexpr const char* kVoStage = "swf_vo";
constexpr const char* kVoStream = "stereo";
/// Keys of laser odometry.
constexpr const char* kLoStage = "laser_odometry";
constexpr const char* kLoStream = "points";
/// Source of edges of visual and laser odometry fused.
constexpr const char* kFusionStage = "odometry_fusion";
/// Properties of a session: the options of the run of `map` that wrote it, one property per given option
/// ("input/option/topic"), one value per line.
constexpr const char* kOptionProperty = "input/option/";
/// Key of the state at the end of a bag (bag_checkpoint.hpp).
constexpr const char* kBagStage = "bag";
/// Key of the state that marks a session whose run of `map` has not ended: removed last, after all files are written.
constexpr const char* kRunStage = "run";
using urban_nav_store::kForcesStage;
using urban_nav_store::packForces;
using urban_nav_store::unpackForces;

}  // namespace urban_nav
