// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// By what the deviations (roots of variances) of edges differ from what their information states: 2 where errors are
/// twice as large. Empty: too few closures to tell.
struct DeviationScales {
  std::optional<double> odometry_translation, odometry_rotation, closure_translation, closure_rotation;
};

/// Variance components of a relaxed graph: sums of squared residuals over their redundancy (Förstner 1979), for
/// translation and rotation, of odometry (Trusted, Asserted) and closures (Candidate) with weight. One step from the
/// factors `odometry` and `closures` of the variances. A prior of a factor of 3 on each deviation keeps what hardly
/// anything controls near 1; where fewer than 100 closures have weight, nothing is stated.
template <int D>
DeviationScales estimateScales(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const std::vector<EdgeAssessment>& edges, const std::vector<Rigid<D>>& poses,
                               const SelectionReport& selection);

}  // namespace pose_graph
