// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_mapper/map_picture.hpp"
#include "topics/lasers/files/map_axes.hpp"

namespace urban_nav {

/// Picture of the map from above in the axes of an export, 0.05 m a pixel up to 800 m. Not thread-safe. The write
/// functions throw UserError naming the path.
class Orthophoto {
 public:
  /// `path`: of the robot, in map. `axes` must outlive this object.
  Orthophoto(const MapAxes& axes, const std::vector<urban_nav_core::Vector3d>& path);

  /// Draws points, which are in the axes.
  void draw(const std::vector<laser_mapper::MapPoint>& points) { picture_.draw(points); }
  /// Writes a PNG and its world file FILE.pgw: pixel sizes, and the centre of the first pixel; in a coordinate system
  /// also FILE.prj.
  void writePng(const std::string& path) const;
  /// Writes a GeoTIFF, transparent where nothing was measured.
  void writeTiff(const std::string& path) const;

 private:
  /// Returns the position of a corner of the pixels in the axes.
  urban_nav_core::Vector3d cornerAt(double u, double v) const;

  const MapAxes& axes_;
  const laser_mapper::MapView view_;
  laser_mapper::MapPicture picture_;
};

/// Writes the world file of an image, FILE.pgw: the sizes of a pixel and the centre of the first one; in a coordinate
/// system also FILE.prj. `corner`: outer corner of the first pixel in the axes, m.
void writeWorldFile(const std::string& image, const MapAxes& axes, double pixel,
                    const urban_nav_core::Vector3d& corner);

}  // namespace urban_nav
