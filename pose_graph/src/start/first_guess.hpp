// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/solution.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

/// Returns the initial guess of a minimisation for options.start.
template <int D>
std::vector<Rigid<D>> firstGuess(const NormalEquations<D>& equations, const Problem<D>& problem,
                                 const SolveOptions& options, const std::vector<double>& weights);

}  // namespace pose_graph
