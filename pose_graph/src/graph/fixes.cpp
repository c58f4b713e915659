// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

void PoseGraph::putFixes(const SessionId& session, const std::vector<PositionFix>& fixes) {
  const auto found = track_of_.find(session);
  if (found == track_of_.end())
    throw urban_nav_core::UserError("pose_graph", "no session " + session, "a session of the graph");
  std::vector<PositionFix>& known = fixes_[found->second];
  for (const PositionFix& fix : fixes)
    if (known.empty() || fix.reading.stamp > known.back().reading.stamp) known.push_back(fix);
}

}  // namespace pose_graph
