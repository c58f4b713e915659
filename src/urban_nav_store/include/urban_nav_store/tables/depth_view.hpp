// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Disparities of dense stereo at a keyframe: a depth image, subsampled to every `step`-th pixel of every `step`-th
/// row.
struct DepthView {
  /// Subsampled image, row by row. All vectors have width * height elements.
  struct Samples {
    int width = 0, height = 0;
    std::vector<float> disparity;    ///< px of the full image, 0 at infinity; <= 0: invalid
    std::vector<float> sigma;        ///< px, standard deviation; 0 if invalid
    std::vector<std::uint8_t> grey;  ///< grey level of the left image
  };

  SessionId session;
  urban_nav_core::StampNs stamp = 0;
  std::int64_t step = 1;                          ///< px, between samples along rows and columns
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px, of the full left image
  double baseline = 0.0;                          ///< m
  urban_nav_core::Pose T_base_camera;             ///< left optical frame
  std::string packed;                             ///< result of pack()

  /// Encodes samples, compressed: disparities to 1/64 px up to 1023 px, standard deviations to 1/64 px up to 4 px.
  /// Disparities that are not finite become invalid.
  static std::string pack(const Samples& samples);
  /// Returns the samples. Throws DataError if the bytes are not those of pack().
  Samples samples() const;

  static Table table() {
    Table table{"depth_view", 2};
    table.since = 8;
    table.kept_by_clear = true;
    table.wide = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", stamp);
    columns.integer("step", step);
    columns.real("fx", fx);
    columns.real("fy", fy);
    columns.real("cx", cx);
    columns.real("cy", cy);
    columns.real("baseline", baseline);
    columns.pose(T_base_camera);
    columns.blob("samples", packed);
  }
};

}  // namespace urban_nav_store
