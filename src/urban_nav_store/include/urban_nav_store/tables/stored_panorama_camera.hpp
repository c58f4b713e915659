// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Calibration of a camera of a panoramic head (0 to 15), or of another camera that colours the map.
struct StoredPanoramaCamera {
  SessionId session;
  static constexpr std::int64_t kFirstColour = 16;  ///< number of the first camera that is not of a panoramic head

  std::int64_t camera = 0;  ///< number of the camera
  std::string frame;
  urban_nav_core::Pose T_base_camera;             ///< of the optical frame
  std::int64_t width = 0, height = 0;             ///< px
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px
  std::array<double, 8> distortion{};             ///< coefficients of urban_nav_core::Distortion
  bool is_equidistant = false;                    ///< fisheye: the first four coefficients are those of its model
  static Table table() {
    Table table{"camera", 2};
    table.since = 3;
    table.wide = true;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("camera", camera);
    columns.text("frame", frame);
    columns.pose(T_base_camera);
    columns.integer("width", width);
    columns.integer("height", height);
    columns.real("fx", fx);
    columns.real("fy", fy);
    columns.real("cx", cx);
    columns.real("cy", cy);
    for (std::size_t i = 0; i < distortion.size(); ++i) columns.real(kNames[i], distortion[i]);
    columns.since(14);
    columns.flag("equidistant", is_equidistant);
  }

 private:
  static constexpr std::array<const char*, 8> kNames = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
};

}  // namespace urban_nav_store
