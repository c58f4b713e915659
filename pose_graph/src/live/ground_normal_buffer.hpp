// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// Buffers normals of the ground until the poses of a session arrive, which lag them, and thins them: a robot that
/// stands sees the same ground again. Bounded: the oldest of too many is dropped.
class GroundNormalBuffer {
 public:
  /// Adds a normal in the axes of base_link.
  void add(const GroundNormal& normal);
  /// Begins a session without poses.
  void beginSession() { last_.reset(); }
  /// Returns the normals at poses of the running session, in order of time, at least 0.25 m or 10 deg after the one
  /// before. Those of stamps that the session has passed without a pose are dropped.
  std::vector<GroundNormal> takeAt(const Track& track);

 private:
  struct Taken {
    StampNs stamp = 0;
    Pose T_odom_base;
  };
  std::deque<GroundNormal> waiting_;
  std::optional<Taken> last_;  ///< of the running session
};

}  // namespace pose_graph
