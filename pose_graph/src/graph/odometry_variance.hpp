// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/solution.hpp"

namespace pose_graph {

/// Rescales the covariances of odometry by the accepted closures. A filter that treats its errors as independent is
/// overconfident over long paths, which only closures reveal.
///
/// Returns the factor of the chains' variances, from 1 to `largest`, for which the residuals of their edges match the
/// stated variances (variance component estimation: Helmert 1924; Koch, Parameter Estimation and Hypothesis Testing in
/// Linear Models, 1999, section 3.6). The information of closures is taken as stated; the stated variance of odometry
/// has the weight of one observed pose, so that a few closures do not dominate. The first `chains` edges of `problem`
/// are odometry; their information is divided by the factor, and `solution` is relaxed with it. No change if closures
/// leave directions unobserved. `begin`: factor by which the information has already been divided.
double takeOdometryVariance(Problem<3>& problem, std::size_t chains, const std::vector<double>& weights,
                            const SolveOptions& options, Solution<3>& solution, double largest, double begin = 1.0);

}  // namespace pose_graph
