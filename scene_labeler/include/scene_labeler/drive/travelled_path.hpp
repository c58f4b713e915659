// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace scene_labeler {

/// Distance travelled along a trajectory. Steps below 5 cm are not counted, which excludes noise at standstill.
class TravelledPath {
 public:
  /// The trajectory must outlive the path.
  explicit TravelledPath(const urban_nav_core::Trajectory& T_world_base) : T_world_base_(T_world_base) { update(); }

  /// Processes the poses appended to the trajectory since the last call.
  void update();

  /// Returns the distance from the first pose to the one nearest in time, m; nullopt outside the trajectory.
  std::optional<double> at(urban_nav_core::StampNs stamp) const;

 private:
  const urban_nav_core::Trajectory& T_world_base_;
  std::vector<double> travelled_;  // of each pose
  std::size_t anchor_ = 0;         // last pose that was counted
};

}  // namespace scene_labeler
