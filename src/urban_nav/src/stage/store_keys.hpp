// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/forces_state.hpp"

namespace urban_nav {

/// Keys of visual odometry in a session store: the source of its edges and of its finished state, its stream.
constexpr const char* kVoStage = "swf_vo";
constexpr const char* kVoStream = "stereo";
/// Key of the state at the end of a bag (bag_checkpoint.hpp).
constexpr const char* kBagStage = "bag";
using pose_graph::kForcesStage;
using pose_graph::packForces;
using pose_graph::unpackForces;

}  // namespace urban_nav
