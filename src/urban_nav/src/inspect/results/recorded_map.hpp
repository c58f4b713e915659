// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// The sessions with poses of one map of a store, for a recording of the results.
class RecordedMap {
 public:
  explicit RecordedMap(const std::vector<urban_nav_store::StoredTrajectory>& map);

  bool empty() const { return sessions_.empty(); }
  const std::vector<urban_nav_store::StoredTrajectory>& sessions() const { return sessions_; }
  /// Returns the frame of the poses: `map`, or `odom` for a session that was neither relaxed nor joined.
  const std::string& frame() const { return frame_; }
  /// Return the stamps of the first and the last pose, ns. Require a non-empty map.
  urban_nav_core::StampNs first() const { return first_; }
  urban_nav_core::StampNs last() const { return last_; }
  /// Returns T_map_base between the two poses around a stamp; nullopt for another session, and outside of its poses.
  std::optional<urban_nav_core::Pose> poseAt(const urban_nav_store::SessionId& session,
                                             urban_nav_core::StampNs stamp) const;

 private:
  std::vector<urban_nav_store::StoredTrajectory> sessions_;
  std::vector<urban_nav_core::Trajectory> trajectories_;  // one per session
  std::string frame_;
  urban_nav_core::StampNs first_ = 0, last_ = 0;
};

}  // namespace urban_nav
