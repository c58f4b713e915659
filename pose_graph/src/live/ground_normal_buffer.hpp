// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// Buffers ground normals until the delayed poses of a session arrive, and thins them, since a standing robot measures
/// the same ground repeatedly. Bounded: the oldest normal is dropped.
class GroundNormalBuffer {
 public:
  /// Adds a normal in the axes of base_link.
  void add(const GroundNormal& normal);
  /// Begins a session without poses.
  void beginSession() { last_.reset(); }
  /// Returns the normals at poses of the active session in order of time, each at least 0.25 m or 10 deg after the
  /// previous one. Normals whose stamps have no pose are dropped once the session is past them.
  std::vector<GroundNormal> takeAt(const Track& track);

 private:
  struct Taken {
    StampNs stamp = 0;
    Pose T_odom_base;
  };
  std::deque<GroundNormal> waiting_;
  std::optional<Taken> last_;  ///< last normal returned in the active session
};

}  // namespace pose_graph
