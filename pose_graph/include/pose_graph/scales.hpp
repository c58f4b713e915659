// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Factors of the standard deviations of edges relative to their information: 2 if errors are twice as large as stated.
/// Empty: too few closures.
struct DeviationScales {
  std::optional<double> odometry_translation, odometry_rotation, closure_translation, closure_rotation;
};

/// Estimates variance components of a relaxed graph: sums of squared residuals over their redundancy (Förstner 1979),
/// separately for translation and rotation, of odometry (Trusted, Asserted) and of weighted closures (Candidate).
/// Computes one step from the variance factors in `selection`. A prior of a factor of 3 on each deviation keeps poorly
/// controlled factors near 1. Returns empty values if fewer than 100 closures have weight.
template <int D>
DeviationScales estimateScales(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const std::vector<EdgeAssessment>& edges, const std::vector<Rigid<D>>& poses,
                               const SelectionReport& selection);

}  // namespace pose_graph
