// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace pose_graph {

/// T_map_odom, by the stamps of the odometry: a pose of the graph lags behind what odometry gave out for the same moment, and where
/// `odom` begins is nobody's business here. Of the newest pose of the running session for which odometry is known:
/// T_map_odom = T_map_base * T_odom_base^-1, both at its stamp.
///
/// Until there is one, `odom` is known to begin where its first pose is the identity: there the map begins too, or, where the session
/// runs on, its newest pose is.
class OdomTie {
 public:
  /// Stamps rise; one that lies more than a second back is a recording that began again, and what was heard before counts no more. A pose
  /// that is the identity, but for round-off, is an odometry that begins anew.
  void hear(const urban_nav_core::StampedPose& odometry);
  /// `running`: the session's track; null where there is none yet. Empty while nothing is known.
  std::optional<Pose> T_map_odom(const Track* running);
  /// The graph is empty: sessions may have the ids of those that are gone.
  void forgetSessions();

 private:
  std::map<StampNs, Pose> heard_;  ///< T_odom_base, from the newest that a pose of the graph was tied to on
  bool begins_ = false;            ///< odom does, and no pose of the graph has been tied to it
  SessionId session_,
      ended_;  ///< of the track seen last; the one that ran when stamps went back: what it says counts no more
  std::optional<Pose> T_map_odom_;
};

}  // namespace pose_graph
