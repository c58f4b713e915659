// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop_metric/parameters.hpp"
#include "loop_metric/surroundings.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// How a closure stands with those beside it: pairs whose ways at both ends are short, so that odometry closes the ring of the two transforms.
struct Neighbours {
  int agreeing = 0, contradicting = 0;
};

/// Holds accepted closures against each other, pair by pair (the ring a_i b_i b_j a_j must close within Parameters::gate), and rejects those that more of
/// their neighbours contradict than bear out, the worst first. Two that contradict each other and have no witness both stay: the pose graph
/// decides. Each closure's numbers, in their order, are returned; LoopReason::Contradicted and a sentence are in those rejected here.
std::vector<Neighbours> holdAgainstEachOther(std::vector<urban_nav_core::MetricClosure>& closures,
                                             const Surroundings& surroundings, const Parameters& parameters);

}  // namespace loop_metric
