// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laser_mapper/map_point.hpp"
#include "topics/lasers/map_crs.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav {

/// Axes that exported files share: those of the frame map, or easting, northing and height of a coordinate system
/// minus an offset of whole metres, so that floats hold them to 0.1 mm.
class MapAxes {
 public:
  /// `crs`: null for the frame map; must outlive the axes. `path`: of the robot, in map; the offset is near its start.
  MapAxes(const MapCrs* crs, const std::vector<urban_nav_core::Vector3d>& path);

  bool areOfMap() const { return crs_ == nullptr; }
  const MapCrs* crs() const { return crs_; }
  /// Returns the offset, m: coordinates of the system are those of the axes plus this.
  const urban_nav_core::Vector3d& offset() const { return offset_; }
  /// Returns the length on the axes of a metre on the ground, horizontally, at the start of the path.
  double scale() const { return scale_; }

  urban_nav_core::Vector3d place(const urban_nav_core::Vector3d& p_map) const;
  std::vector<urban_nav_core::Vector3d> place(const std::vector<urban_nav_core::Vector3d>& path) const;
  /// Returns the point with its position and normal in these axes.
  laser_mapper::MapPoint place(const laser_mapper::MapPoint& point) const;
  /// Returns the points in these axes. `buffer`: holds them unless the axes are those of map.
  const std::vector<laser_mapper::MapPoint>& place(const std::vector<laser_mapper::MapPoint>& points,
                                                   std::vector<laser_mapper::MapPoint>& buffer) const;
  /// Returns the point of the map at a position in these axes.
  urban_nav_core::Vector3d toMap(const urban_nav_core::Vector3d& p) const;

 private:
  const MapCrs* crs_;
  urban_nav_core::Vector3d offset_ = urban_nav_core::Vector3d::Zero();
  Eigen::Matrix3f turn_ = Eigen::Matrix3f::Identity();  ///< rotation of normals, about the vertical
  double scale_ = 1.0;
};

}  // namespace urban_nav
