// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/level.hpp"
#include "pose_graph/marginals.hpp"
#include "pose_graph/pose_graph.hpp"
#include "stage/closures_file.hpp"
#include "stages/vo/vo_stage.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav {

/// A closure that an earlier run offered to the graph, between poses of sessions that are here again.
struct KnownClosure {
  ClosureRow row;
  pose_graph::Closure closure;  ///< sessions by their names
};

/// What relaxation made of all sessions. Sessions are named as closures.csv names them.
struct GraphRun {
  pose_graph::PoseGraph graph{pose_graph::Parameters()};
  pose_graph::Relaxed relaxed;
  std::vector<std::string> sessions;  ///< names, in the order of the runs
  std::vector<ClosureRow> closures;   ///< with their verdicts: the known ones, then those of the file
  std::vector<std::string> warnings;
  double ms = 0.0, ms_covariances = 0.0;  ///< that the relaxation took, and what follows from it
  /// Marginal covariances of T_first_base of each session's poses, as far as they are known; odometry's own where no closure was accepted.
  std::vector<std::vector<urban_nav_core::Matrix6d>> covariances;

  /// The first session in whose map this one lies as a whole: itself where it joined none before it.
  std::size_t mapOf(std::size_t session) const;
  /// Does it lie in the map of the first session?
  bool joined(std::size_t session) const { return mapOf(session) == 0; }
  std::size_t sessionsJoined() const;
  /// Which way is up in the map that begins with a session, seen from its first pose: by the first of its sessions that knows. Of sessions
  /// that lie in the map of another, nothing.
  std::vector<pose_graph::Level> levels;
  /// The poses of a session in its map: origin and heading of the map's first pose, and level where that is known.
  urban_nav_core::Trajectory trajectory(std::size_t session) const;
};

/// Takes the settled chains of the runs and the closures with their transforms. A closure whose moments lie between frames
/// is carried to the nearest ones by the odometry in between. One that cannot be used is rejected with the reason, never lost.
/// A closure that is known gives way to one of the file with the same poses and kind. The order of closures is of no
/// influence on the poses, bit by bit.
GraphRun runGraph(const pose_graph::Parameters& parameters, const std::vector<const VoRun*>& runs,
                  const std::vector<std::string>& sessions, const std::vector<ClosureRow>& closures,
                  const std::vector<KnownClosure>& known = {});

}  // namespace urban_nav
