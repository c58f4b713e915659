// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace pose_graph {

/// Estimates T_map_odom = T_map_base * T_odom_base^-1 at the newest pose of the active session with known odometry,
/// because the graph lags odometry. Independent of the origin of `odom`.
///
/// If there is no such pose yet and odometry begins at the identity, `odom` is placed at the newest pose of the active
/// session, or at the map origin without one.
class MapToOdomEstimator {
 public:
  /// Adds T_odom_base. A stamp that jumps back (urban_nav_live::TimeJumpDetector) indicates a restarted recording, and
  /// earlier odometry is discarded. An identity pose (up to rounding) after another pose indicates restarted odometry.
  void addOdometry(const urban_nav_core::StampedPose& odometry);
  /// Returns T_map_odom; empty while unknown. `running`: track of the active session; null: none.
  std::optional<Pose> estimate(const Track* running);
  /// Resets the session state after the graph was cleared: later sessions may have the same ids.
  void forgetSessions();

 private:
  std::map<StampNs, Pose> odometry_;  ///< T_odom_base since the newest matched pose of the graph
  bool starts_at_identity_ = false;   ///< `odom` begins at the identity, and no pose of the graph has been matched yet
  SessionId session_;                 ///< session of the newest track
  SessionId ended_session_;           ///< active session when stamps jumped back: its poses are ignored
  std::optional<Pose> T_map_odom_;
};

}  // namespace pose_graph
