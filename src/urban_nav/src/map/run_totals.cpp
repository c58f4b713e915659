// SPDX-License-Identifier: BSD-3-Clause
#include "map/run_totals.hpp"

#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav {

RunTotals totals(const std::vector<const SessionOdometry*>& runs) {
  RunTotals made;
  for (const SessionOdometry* run : runs) {
    made.frames += static_cast<std::int64_t>(run->frames.size());
    std::vector<urban_nav_core::Vector3d> positions;
    for (const SmoothedFrame& settled : run->settled) positions.push_back(settled.T_odom_base.pose.t());
    made.distance_m += urban_nav_core::travelledLength(positions);
    if (run->settled.size() > 1)
      made.seconds += urban_nav_core::secondsBetween(run->settled.front().stamp, run->settled.back().stamp);
  }
  return made;
}

RunTotals ownTotals(const MapContext& context) {
  std::vector<const SessionOdometry*> runs;
  for (const MapSession& session : context.sessions) runs.push_back(session.odometry.get());
  return totals(runs);
}

}  // namespace urban_nav
