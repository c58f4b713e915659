// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop_metric/parameters.hpp"
#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// Numbers of neighbouring closures consistent with a closure and contradicting it. Two closures are neighbours if they
/// are near each other at both ends, so that odometry closes the loop of the two transforms.
struct Neighbours {
  int agreeing = 0, contradicting = 0;
};

/// Compares accepted closures pairwise (the loop a_i b_i b_j a_j must close within Parameters::gate), and rejects those
/// with more contradicting than consistent neighbours, the worst first. Two contradicting closures without further
/// neighbours are both kept, for the robust selection of the pose graph. Returns the counts of each closure, in their
/// order. Rejected closures get LoopReason::Contradicted and a sentence.
std::vector<Neighbours> pairwiseConsistencyCheck(std::vector<urban_nav_core::MetricClosure>& closures,
                                                 const PlaceData& place_data, const Parameters& parameters);

}  // namespace loop_metric
