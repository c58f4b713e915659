// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pose_graph/solution.hpp"

namespace pose_graph {

/// A minimiser for comparison, which relaxes the accepted closures in place of solve(). Each lies in a library of its
/// own (reference/), and whoever offers it hands it to run() or PoseGraph::relax().
struct ReferenceSolver {
  std::string name;  ///< the value of pose_graph.solver that selects it
  /// As solve(). `weights`: a factor for each edge, 0 for closures that are not accepted.
  std::function<Solution<3>(const Problem<3>& problem, const SolveOptions& options, const std::vector<double>& weights)>
      solve;
};
using ReferenceSolvers = std::vector<ReferenceSolver>;

/// Returns the solver that a value of pose_graph.solver selects; null: the stage's own, gauss_newton. Throws UserError,
/// with the allowed values, if `references` has no such name either.
const ReferenceSolver* findReference(const std::string& name, const ReferenceSolvers& references);

}  // namespace pose_graph
