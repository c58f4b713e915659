// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "robust/admission_thresholds.hpp"
#include "robust/evidence.hpp"

namespace pose_graph {

/// A relaxation that decides on one group: a difference of two costs has to be good to a number or so.
constexpr int kGroupSteps = 20;
constexpr double kGroupShare = 1e-6;

/// So many true ones stand against one false one that is in their way; a false group meets as many true ones as it has
/// members. For fewer no room is made.
constexpr std::size_t kForOne = 8;

/// Continues from a graph with a group that contradicts the others: who is contradicted beside it leaves, the worst
/// ones first. True if all that remain fit, and the group drove out but few for what it is itself. `in`, `poses`: with
/// the group, and after.
template <int D>
bool exchangeGroup(const ClosureEvaluator<D>& evaluator, const Thresholds& thresholds, const std::vector<int>& members,
                   double variance, AcceptedGraph<D>& graph, std::vector<char>& in, std::vector<Rigid<D>>& poses);

}  // namespace pose_graph
