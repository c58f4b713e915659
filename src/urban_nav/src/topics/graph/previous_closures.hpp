// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Closures between stored sessions in the graph of earlier runs; sessions by their names.
struct PreviousClosures {
  std::vector<urban_nav_core::MetricClosure> offered;  ///< as read or measured by the earlier run
  std::vector<pose_graph::Closure> in_graph;           ///< one for each of `offered`
  std::vector<pose_graph::Closure> planes = {};        ///< constraints from planes
};

/// Returns the stored closures and planes between these sessions, including asserted ones, without those of edits.
/// `names`: one per id.
PreviousClosures closuresBetween(urban_nav_store::Store& store, const std::vector<urban_nav_store::SessionId>& ids,
                                 const std::vector<std::string>& names);

}  // namespace urban_nav
