// SPDX-License-Identifier: BSD-3-Clause
#include "stage/run_totals.hpp"

#include "evaluation/statistics.hpp"

namespace urban_nav {

RunTotals totals(const std::vector<const VoRun*>& runs) {
  RunTotals made;
  for (const VoRun* run : runs) {
    made.frames += static_cast<std::int64_t>(run->rows.size());
    std::vector<urban_nav_core::Vector3d> positions;
    for (const swf_vo::Settled& settled : run->settled) positions.push_back(settled.T_odom_base.pose.t());
    made.distance_m += pathLength(positions);
    if (run->settled.size() > 1)
      made.seconds += urban_nav_core::secondsBetween(run->settled.front().stamp, run->settled.back().stamp);
  }
  return made;
}

RunTotals ownTotals(const MapContext& context) {
  std::vector<const VoRun*> runs;
  for (const MapSession& session : context.sessions) runs.push_back(session.vo.get());
  return totals(runs);
}

}  // namespace urban_nav
