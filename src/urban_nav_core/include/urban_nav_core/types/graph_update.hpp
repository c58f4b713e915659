// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/types/closure.hpp"

namespace urban_nav_core {

/// Where base_link was at a time, in the map.
struct StampedMapPose {
  StampNs stamp = 0;
  Pose T_map_base;
};

/// Consecutive poses of one session, in order of time.
struct PoseRun {
  std::string session;
  std::vector<StampedMapPose> poses;
};

/// What other stages follow: the poses that moved by more than 1 cm or 0.02 deg since the revision before. Who missed
/// one
/// (`previous` is not the revision they have) asks for the trajectory.
struct GraphUpdate {
  std::int64_t revision = 0;
  std::int64_t previous = 0;
  std::vector<PoseRun> runs;
};

/// Names an edge of the graph.
struct EdgeRef {
  PoseRef a, b;
  std::string kind;    ///< odometry, stereo, icp, plane, session, asserted
  std::string source;  ///< who measured it
};
bool operator==(const EdgeRef& a, const EdgeRef& b);

/// The robot's own pose in the map moved at once, since closures say so; its pose in `odom` did not.
struct MapJump {
  std::int64_t revision = 0;  ///< the first with the new pose
  PoseRef at;                 ///< the robot's pose
  Pose T_map_base_before, T_map_base_after;
  int reason = 0;  ///< enumerator of the stage, 0: none
  std::string reason_name, sentence;
  std::vector<EdgeRef> witnesses;  ///< the closures that made it move
};

}  // namespace urban_nav_core
