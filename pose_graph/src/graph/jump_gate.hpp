// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "incremental/incremental_solver.hpp"
#include "pose_graph/pose_graph.hpp"
#include "pose_graph/reference_solver.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Factor of the information of a slipped step; it keeps the chain connected if its closures are removed.
constexpr double kSlippedShare = 1e-6;

/// A graph relaxed with the accepted closures.
struct Assessment {
  Solution<3> solution;
  SelectionReport selection;
  std::vector<int> slipped;  ///< ascending edges of the problem: steps of odometry that closures contradict
};

/// Selects closures and relaxes. The selection is that of `relax` (relaxSelected()), followed by the rule that a large
/// correction requires two consistent closures (docs/derivations/pose_graph.md). A closure waits if so far only
/// odometry connects a to b, if it deviates from that by more than parameters.confirmation_distance or
/// confirmation_angle, if it is not a stereo closure within the odometry gate, and if no other accepted closure spans
/// part of the same path.
///
/// Sets verdicts, weights and reasons of `closures`; waiting and rejected ones have weight 0 in the solution.
/// `reference`: solver used instead of solve(), if not null. In `problem`, a slipped step is replaced by the motion of
/// the solution with almost no information, and the information of chains and closures is divided by the factors of the
/// selection if SelectionReport::rescaled.
Assessment assess(Problem<3>& problem, const Parameters& parameters, const SolveOptions& options,
                  const ReferenceSolver* reference, std::map<ClosureId, Closure>& closures);

/// Result of evaluateAddition().
struct Addition {
  double cost_before = 0.0;   ///< cost of the initial poses, with the closures accepted last
  bool disagreement = false;  ///< a closure was rejected, or more closures wait than were tried with it
  bool provisional = false;   ///< a closure was accepted without a comparison of sets
  bool others_wait = false;   ///< a closure accepted earlier waits now: `core` no longer matches the accepted closures
};
/// Tests the closures without a verdict one by one against the accepted ones, together with waiting closures that may
/// confirm them. Accepted ones stay in `core`.
Addition evaluateAddition(IncrementalSolver& core, const GraphView& view, const Parameters& parameters,
                          const std::map<ClosureId, ClosureEdge>& closure_edges,
                          std::map<ClosureId, Closure>& closures);

}  // namespace pose_graph
