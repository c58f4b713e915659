// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// The sessions of another store for comparison with the shown map: the store before its edits, of another build, or
/// with other sessions. The frames of both maps are not aligned, since a shift of the origin is a difference too.
class ComparedMap {
 public:
  using Maps = std::vector<std::vector<urban_nav_store::StoredTrajectory>>;

  /// Reads the trajectories of a store. Throws the errors of the store.
  explicit ComparedMap(const std::string& path);

  /// Returns the distances between the poses of these maps and those of the other store: `store`, `sessions` (of those
  /// in both: `session`, its place in the order of `maps`, `poses` that were compared, `largest_m`, `rms_m`, and
  /// `seconds` since the beginning of the session at the largest), and `absent_there` and `absent_here`, names of
  /// sessions.
  Json summary(const Maps& maps) const;

  /// Returns the position in the other store of each pose of `maps`, in their order: x, y, z (m) as little-endian
  /// float32; NaN for missing poses.
  std::string place(const Maps& maps) const;

 private:
  struct Session {
    std::string name;
    urban_nav_core::Trajectory T_map_base;
  };
  std::string path_;
  std::map<urban_nav_store::SessionId, Session> sessions_;
};

}  // namespace urban_nav
