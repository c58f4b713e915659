// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/level.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Takes out of odometry what the accelerometer knows better: the drift of roll and pitch (tiltDrift). Of each unbroken
/// run of a track the steps turn a little, and its poses are laid anew from its first one; translations of steps,
/// headings and information stay as they are. The poses of the tracks stand one after another in `problem`, and its
/// first `chains` edges are their steps. `stamps`, `forces`: of each track. The most that a pose leant, rad.
double levelOdometry(Problem<3>& problem, std::size_t chains,
                     const std::vector<std::vector<urban_nav_core::StampNs>>& stamps,
                     const std::vector<std::vector<SpecificForce>>& forces);

}  // namespace pose_graph
