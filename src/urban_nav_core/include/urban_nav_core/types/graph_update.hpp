// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/types/closure.hpp"

namespace urban_nav_core {

/// Pose of base_link in the map at a time.
struct StampedMapPose {
  StampNs stamp = 0;
  Pose T_map_base;
};

/// Consecutive poses of one session, in order of time.
struct TrajectorySegment {
  std::string session;
  std::vector<StampedMapPose> poses;
};

/// Poses that moved by more than 1 cm or 0.02 deg since revision `previous`. A subscriber at another revision has
/// missed an update and must request the trajectory.
struct GraphUpdate {
  std::int64_t revision = 0;
  std::int64_t previous = 0;
  std::vector<TrajectorySegment> segments;
};

/// Identifies an edge of the graph.
struct EdgeRef {
  PoseRef a, b;
  std::string kind;    ///< odometry, stereo, icp, plane, session, asserted
  std::string source;  ///< stage that measured it
};
bool operator==(const EdgeRef& a, const EdgeRef& b);

/// A discontinuous correction of the robot's pose in the map, caused by closures; its pose in `odom` is continuous.
struct PoseCorrection {
  std::int64_t revision = 0;  ///< first revision with the new pose
  PoseRef at;                 ///< robot's pose that was corrected
  Pose T_map_base_before, T_map_base_after;
  int reason = 0;  ///< enumerator of the stage; 0: none
  std::string reason_name, sentence;
  std::vector<EdgeRef> causing_edges;  ///< closures that were accepted, rejected or removed
};

}  // namespace urban_nav_core
