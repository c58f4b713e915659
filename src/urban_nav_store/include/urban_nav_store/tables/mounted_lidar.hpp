// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// 3D LiDAR of a session whose sweeps are stored (lidar_sweep.hpp).
struct MountedLidar {
  SessionId session;
  std::string role;   ///< "points0"
  std::string frame;  ///< frame of its points
  urban_nav_core::Pose T_base_lidar;

  static Table table() {
    Table table{"mounted_lidar", 2};
    table.since = 8;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("role", role);
    columns.text("frame", frame);
    columns.pose(T_base_lidar);
  }
};

}  // namespace urban_nav_store
