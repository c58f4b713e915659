// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace pose_graph {

/// Estimates T_map_odom from the newest pose of the running session for which odometry is known: T_map_odom =
/// T_map_base * T_odom_base^-1, both at its stamp, since the graph lags odometry. Independent of the origin of `odom`.
///
/// Before there is such a pose, an odometry that begins at the identity places `odom` at the newest pose of the running
/// session, or at the origin of the map if there is none.
class MapToOdomEstimator {
 public:
  /// Adds T_odom_base. A stamp that jumps back (urban_nav_live::TimeJumpDetector) means a restarted recording: earlier
  /// odometry is discarded. A pose that is the identity, up to rounding, after one that is not means a restarted
  /// odometry.
  void addOdometry(const urban_nav_core::StampedPose& odometry);
  /// Returns T_map_odom; empty while it is not known. `running`: track of the running session; null: none.
  std::optional<Pose> estimate(const Track* running);
  /// Forgets the sessions of a graph that is empty now: later ones may have the same ids.
  void forgetSessions();

 private:
  std::map<StampNs, Pose> odometry_;  ///< T_odom_base, from the newest pose of the graph that was matched on
  bool starts_at_identity_ = false;   ///< `odom` does, and no pose of the graph has been matched
  SessionId session_;                 ///< of the newest track
  SessionId ended_session_;           ///< the one that ran when stamps jumped back: its poses do not count
  std::optional<Pose> T_map_odom_;
};

}  // namespace pose_graph
