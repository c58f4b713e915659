// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/solution.hpp"

namespace pose_graph {

/// What the accepted closures say of odometry's covariances: a filter that takes its errors for independent promises
/// more than it keeps over a long way, and only who comes back learns of it.
///
/// Returns the factor of the chains' variances, from 1 to `largest`, with which their edges' residuals are as stated
/// (estimation of variance components: Helmert 1924; Koch, Parameter Estimation and Hypothesis Testing in Linear
/// Models, 1999, section 3.6). The closures' information is taken as it is stated, and so is odometry's with the weight
/// of one observed pose: a few closures do not decide. The first `chains` edges of `problem` are odometry; their
/// information is divided by the factor, and `solution` is relaxed with it. Nothing is changed where closures leave
/// directions free. `begin`: factor by which that information is divided already.
double takeOdometryVariance(Problem<3>& problem, std::size_t chains, const std::vector<double>& weights,
                            const SolveOptions& options, Solution<3>& solution, double largest, double begin = 1.0);

}  // namespace pose_graph
