// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/layers/ground_grid.hpp"
#include "laser_mapper/map_point.hpp"
#include "laser_mapper/sensors.hpp"
#include "map/point_attributes.hpp"
#include "topics/lasers/files/map_axes.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/io/cloud/las_writer.hpp"
#include "urban_nav_core/io/cloud/pcd_writer.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace urban_nav {

/// Writer of the formats with a record for each point. PLY and PCD are in the frame map, LAS in the axes of the export.
/// In LAS the class of a point is that of its label; ground of any kind is class 2, and so is what has no label and
/// lies on the ground. Not thread-safe. Throws UserError naming the path.
class PointFiles {
 public:
  /// `axes`: of the LAS file. `ground`: in these axes, for the class of points in it; null without a LAS file. Both
  /// must outlive this object. `more`: attributes of all points; nullopt: none.
  PointFiles(const MapFilePaths& paths, const MapAxes& axes, const laser_mapper::GroundGrid* ground,
             const std::vector<laser_mapper::SensorName>& sensors, std::optional<PointAttributes> more);

  void append(const std::vector<laser_mapper::MapPoint>& points);
  void commit();

 private:
  urban_nav_core::PlyLayout plyLayout(const std::vector<laser_mapper::SensorName>& sensors) const;
  void appendPly(const laser_mapper::MapPoint& point);
  void appendPcd(const laser_mapper::MapPoint& point);
  void appendLas(const laser_mapper::MapPoint& point);

  const MapAxes& axes_;
  const laser_mapper::GroundGrid* ground_;
  const std::optional<PointAttributes> more_;
  std::size_t next_ = 0;  ///< number of the next point
  std::optional<urban_nav_core::PlyWriter> ply_;
  std::optional<urban_nav_core::PcdWriter> pcd_;
  std::optional<urban_nav_core::LasWriter> las_;
  std::string bytes_;
};

}  // namespace urban_nav
