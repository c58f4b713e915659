// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace pose_graph {

/// Converts a measured closure. A pose without a session belongs to the active one; its session is left empty. The
/// verdict is Rejected if the stage has rejected the closure: its evidence is stored, and it is not part of the graph.
Closure toClosure(const urban_nav_core::MetricClosure& closure);
/// Converts a constraint. Throws UserError for a kind that must not be added from outside.
Closure toClosure(const urban_nav_core::RelativeConstraint& constraint);
/// Returns the kind of that name. Throws UserError for a kind that must not be added from outside.
EdgeKind toEdgeKind(const std::string& word);

}  // namespace pose_graph
