// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/solution.hpp"

namespace pose_graph {

/// Solves the geodesic objective by way of the core graph. Returns nullopt if too few poses are on chains, or if it did
/// not converge (the caller then solves the full graph).
template <int D>
std::optional<Solution<D>> solveCondensed(const Problem<D>& problem, const SolveOptions& options,
                                          const std::vector<double>& weights);

}  // namespace pose_graph
