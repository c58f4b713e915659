// SPDX-License-Identifier: BSD-3-Clause
#include "map/session_trajectory.hpp"

namespace urban_nav {

std::vector<SessionTrajectory> odometryTrajectories(const std::vector<const SessionOdometry*>& runs,
                                                    std::size_t previous) {
  std::vector<SessionTrajectory> result;
  for (std::size_t s = 0; s < runs.size(); ++s) {
    std::vector<urban_nav_core::Matrix6d> covariances;
    for (const SmoothedFrame& settled : runs[s]->settled) covariances.push_back(settled.T_odom_base.covariance);
    result.push_back({smoothedTrajectory(*runs[s]), std::move(covariances), s, s >= previous, std::nullopt});
  }
  return result;
}

}  // namespace urban_nav
