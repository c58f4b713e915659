// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/level.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Corrects the drift of roll and pitch of odometry by the accelerometer (tiltDrift()). In each unbroken run of a track
/// the steps are rotated slightly, and the poses are recomputed from the first one; translations of steps, headings and
/// information are unchanged. The tracks' poses are consecutive in `problem`; its first `chains` edges are their steps.
/// `stamps`, `forces`: per track. Returns the largest tilt of a pose, rad.
double levelOdometry(Problem<3>& problem, std::size_t chains,
                     const std::vector<std::vector<urban_nav_core::StampNs>>& stamps,
                     const std::vector<std::vector<SpecificForce>>& forces);

}  // namespace pose_graph
