// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "robust/consistent_groups.hpp"
#include "robust/evidence.hpp"

namespace pose_graph {

/// Variance of unit weight of the edges that are in, each counted no further than its limit. Starts from what is
/// expected by `scale` (InformationScale::factor) with the weight of ten observed tangents, so that a few redundant
/// edges do not decide; false ones that agree with each other are in `scale` too, so that it is no bound from below.
template <int D>
double varianceFactor(const ClosureEvaluator<D>& evaluator, const std::vector<char>& in,
                      const std::vector<Rigid<D>>& poses, int unknowns, const Thresholds& thresholds, double scale);

}  // namespace pose_graph
