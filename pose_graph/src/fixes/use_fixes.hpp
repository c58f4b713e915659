// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fixes/placed_fixes.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {

/// Relaxes a graph once more together with fixes, each a measurement of a position in a frame (east, north, up) whose
/// place in the map is estimated with the poses. A fix loses its weight by what it is off (Cauchy 1853; the width
/// begins at the largest error and narrows, Black and Rangarajan 1996), standard deviations that are too small are
/// enlarged by the median error, and odometry's variance is enlarged where the fixes show that it promises too much, as
/// by takeOdometryVariance().
///
/// `problem`: the graph, whose first `chains` edges are odometry, `weights` those of its edges, `solution` its relaxed
/// poses: takes the new ones. `odometry_variance` is multiplied by the factor by which the information of the chains
/// was divided. Without fixes nothing changes.
FixUse useFixes(Problem<3>& problem, std::size_t chains, const std::vector<double>& weights,
                const std::vector<FixedPart>& parts, const SolveOptions& options, Solution<3>& solution,
                double& odometry_variance);

}  // namespace pose_graph
