// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace pose_graph {

/// Closure on its way into the graph.
struct ClosureInput {
  Closure closure;
  bool rejected = false;  ///< by the stage that measured it: stored as evidence, not part of the graph
  std::string evidence;
};

/// Converts a measured closure. A pose without a session belongs to the running one: its session is left empty.
ClosureInput toClosureInput(const urban_nav_core::MetricClosure& closure);
/// Converts a constraint. Throws UserError for a kind that may not be added from outside.
ClosureInput toClosureInput(const urban_nav_core::RelativeConstraint& constraint);
/// Returns the kind of that name. Throws UserError for a kind that may not be added from outside.
EdgeKind toEdgeKind(const std::string& word);

}  // namespace pose_graph
