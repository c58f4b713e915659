// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pose_graph/solution.hpp"

namespace pose_graph {

/// A minimiser for comparison that relaxes the accepted closures instead of solve(). Each is in a separate library
/// (reference/); a program passes those it offers to run() or PoseGraph::relax().
struct ReferenceSolver {
  std::string name;  ///< value of pose_graph.solver that selects it
  /// As solve(). `weights`: a factor per edge, 0 for closures that are not accepted.
  std::function<Solution<3>(const Problem<3>& problem, const SolveOptions& options, const std::vector<double>& weights)>
      solve;
};
using ReferenceSolvers = std::vector<ReferenceSolver>;

/// Returns the solver selected by a value of pose_graph.solver; null for gauss_newton. Throws UserError with the
/// allowed values if `references` does not contain `name`.
const ReferenceSolver* findReference(const std::string& name, const ReferenceSolvers& references);

}  // namespace pose_graph
