// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fixes/placed_fixes.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {

/// Relaxes a graph with position fixes. Each is a position in a frame (east, north, up) whose pose in the map is
/// estimated too. Fixes are weighted by Cauchy's kernel, whose width decreases from the largest error (Black and
/// Rangarajan 1996). Standard deviations that are too small are increased by the median error, and the variance of
/// odometry is increased if the fixes show it to be overconfident, as in takeOdometryVariance().
///
/// `problem`: the graph; its first `chains` edges are odometry. `weights`: of its edges. `solution`: relaxed poses,
/// which are updated. `odometry_variance`: multiplied by the divisor of the chains' information. Without fixes nothing
/// changes.
FixUse useFixes(Problem<3>& problem, std::size_t chains, const std::vector<double>& weights,
                const std::vector<FixedPart>& parts, const SolveOptions& options, Solution<3>& solution,
                double& odometry_variance);

}  // namespace pose_graph
