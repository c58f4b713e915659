// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace pose_graph {

/// A closure on its way into the graph, or past it.
struct Offered {
  Closure closure;
  bool rejected = false;  ///< by who found it: evidence for the store alone
  std::string evidence;
};

/// What came by a topic. A pose that names no session is of the one that is running: its session stays empty here.
Offered offeredOf(const urban_nav_core::MetricClosure& closure);
Offered offeredOf(const urban_nav_core::RelativeConstraint& constraint);
/// The kinds that may come from outside. UserError for another word.
EdgeKind kindOf(const std::string& word);

}  // namespace pose_graph
