// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/solution.hpp"

namespace pose_graph {

/// solve() by way of the core, for the geodesic objective: empty where too few poses lie on chains for that to pay, or
/// where it did not come to its end (the caller then takes the whole graph at once).
template <int D>
std::optional<Solution<D>> solveCondensed(const Problem<D>& problem, const SolveOptions& options,
                                          const std::vector<double>& weights);

}  // namespace pose_graph
