// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Points of dense stereo at a keyframe, in base_link at its stamp.
struct NearPoints {
  struct Point {
    Eigen::Vector3f p_base = Eigen::Vector3f::Zero();  ///< m
    float sigma = 0.0F;                                ///< m, standard deviation along the line of sight
    std::uint8_t grey = 0;                             ///< grey level of the left image
  };

  SessionId session;
  urban_nav_core::StampNs stamp = 0;
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();  ///< m, centre of the left camera in base_link
  double pixel_angle = 0.0;                          ///< rad, angle of a pixel of the left image
  std::string packed;                                ///< result of pack()

  /// Encodes points in nine bytes each, with a resolution of 0.25 mm in position and 0.1 mm in sigma. Points more than
  /// 8.19 m from base_link in an axis, or not finite, are omitted; sigma is at most 6.55 m.
  static std::string pack(const std::vector<Point>& points);
  /// Returns the points. Throws DataError if the bytes are not those of pack().
  std::vector<Point> points() const;
  /// Returns the covariance of a point in base_link, m^2: sigma along the line of sight, a third of a pixel across.
  Eigen::Matrix3d covariance(const Point& point) const;

  static Table table() {
    Table table{"near_points", 2};
    table.since = 3;
    table.kept_by_clear = true;
    table.wide = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", stamp);
    columns.real("camera_x", camera.x());
    columns.real("camera_y", camera.y());
    columns.real("camera_z", camera.z());
    columns.real("pixel_angle", pixel_angle);
    columns.blob("points", packed);
  }
};

}  // namespace urban_nav_store
