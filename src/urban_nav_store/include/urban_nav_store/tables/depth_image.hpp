// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/tables/depth_view.hpp"

namespace urban_nav_store {

/// Image of a depth camera, from which a map can be rebuilt without the recording. Its depths z are stored as
/// disparities kFocalBaseline / z, in the samples of a DepthView, as their errors grow with the square of the depth.
struct DepthImage {
  static constexpr double kFocalBaseline = 50.0;  ///< px m: depths to 2.5 mm at 4 m, from 0.05 m

  SessionId session;
  std::string role;  ///< "depth0"
  urban_nav_core::StampNs stamp = 0;
  std::string frame;                              ///< optical frame
  std::int64_t step = 1;                          ///< px, between samples along rows and columns
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px, of the full image
  urban_nav_core::Pose T_base_camera;
  std::string packed;  ///< result of DepthView::pack()

  static Table table() {
    Table table{"depth_image", 3};
    table.since = 13;
    table.kept_by_clear = true;
    table.wide = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("role", role);
    columns.integer("stamp_ns", stamp);
    columns.text("frame", frame);
    columns.integer("step", step);
    columns.real("fx", fx);
    columns.real("fy", fy);
    columns.real("cx", cx);
    columns.real("cy", cy);
    columns.pose(T_base_camera);
    columns.blob("samples", packed);
  }
};

}  // namespace urban_nav_store
