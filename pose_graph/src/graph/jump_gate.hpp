// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "incremental/incremental_solver.hpp"
#include "pose_graph/pose_graph.hpp"
#include "pose_graph/reference_solver.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Share of its information that a step that slipped keeps: it holds a chain together where its closures are removed.
constexpr double kSlippedShare = 1e-6;

/// A graph relaxed with the closures that are accepted.
struct Assessment {
  Solution<3> solution;
  SelectionReport selection;
  std::vector<int> slipped;  ///< edges of the problem, ascending: steps of odometry that closures contradict
};

/// Accepted closures, and the poses that follow: the selection of `relax` (relaxSelected()), then the rule that a large
/// correction needs two witnesses (docs/derivations/pose_graph.md).
/// A closure waits where odometry alone led from a to b so far,
/// it says something further off than parameters.confirmation_distance or confirmation_angle, it is no stereo closure
/// that odometry allows, and no other accepted closure spans a part of the same way. `closures` get their verdicts,
/// weights and reasons; those that wait or are rejected have weight 0 in the solution. `reference`: relaxes what is
/// accepted in place of solve(), if not null. A step that slipped measures in `problem` from then on what the solution
/// has in its place, with next to no information; the information of chains and closures is divided by the factors of
/// the selection where SelectionReport::rescaled.
Assessment assess(Problem<3>& problem, const Parameters& parameters, const SolveOptions& options,
                  const ReferenceSolver* reference, std::map<ClosureId, Closure>& closures);

/// Closures that were not judged yet, each beside what is accepted already, and those that waited for one like it;
/// those that are let in stay in `core`.
struct Addition {
  double cost_before = 0.0;   ///< where the poses stood, with what was let in last
  bool disagreement = false;  ///< one of them was left out, or more wait than were tried beside it
  bool provisional = false;   ///< one of them was let in: no other set of closures was weighed
  bool others_wait = false;   ///< one that was accepted before waits now: `core` is no longer that of the accepted ones
};
Addition judgeAddition(IncrementalSolver& core, const GraphView& view, const Parameters& parameters,
                       const std::map<ClosureId, ClosureEdge>& closure_edges, std::map<ClosureId, Closure>& closures);

}  // namespace pose_graph
