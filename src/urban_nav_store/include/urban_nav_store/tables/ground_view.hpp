// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Ground plane measured by dense stereo at a keyframe: up . p + height = 0 in base_link.
struct GroundView {
  SessionId session;
  urban_nav_core::StampNs stamp = 0;
  std::string verdict;                            ///< "found", or the reason why there is no plane
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit normal in base_link, away from the ground
  double height = 0.0;                            ///< m, of the origin of base_link above the plane
  double sigma = 0.0;                             ///< rad, standard deviation of the normal's direction
  double support = 0.0;                           ///< share of the ground's area on the plane

  static Table table() {
    Table table{"ground_view", 2};
    table.since = 3;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", stamp);
    columns.text("verdict", verdict);
    columns.real("up_x", up.x());
    columns.real("up_y", up.y());
    columns.real("up_z", up.z());
    columns.real("height", height);
    columns.real("sigma", sigma);
    columns.real("support", support);
  }
};

}  // namespace urban_nav_store
