// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "map/session_odometry.hpp"

namespace urban_nav {

/// Poses of a session in the files of the run.
struct SessionTrajectory {
  urban_nav_core::Trajectory T_map_base;
  std::vector<urban_nav_core::Matrix6d> covariances;    ///< of T_first_base; may be shorter than the trajectory
  std::size_t map = 0;                                  ///< number of the first session of its map
  bool written = true;                                  ///< false: a previous session that this run does not change
  std::optional<urban_nav_core::Trajectory> localized;  ///< poses in the map given by --localise
};

/// Returns the trajectories by odometry only, each session in a separate map. The first `previous` sessions are not
/// written.
std::vector<SessionTrajectory> odometryTrajectories(const std::vector<const SessionOdometry*>& runs,
                                                    std::size_t previous = 0);

}  // namespace urban_nav
