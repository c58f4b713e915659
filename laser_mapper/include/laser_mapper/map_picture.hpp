// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_registration/pictures/picture.hpp"

namespace laser_mapper {

/// Camera of a picture: x right, y down, z away from the viewer.
struct MapView {
  int width = 1200, height = 900;  ///< px
  urban_nav_core::Pose T_camera_map;
  double px_per_m = 10.0;        ///< of the parallel projection from above
  double focal_px = 0.0;         ///< of the perspective projection; 0: parallel projection
  double near = 0.5, far = 1e9;  ///< m: points nearer or farther are not drawn
};

/// Returns a top view, with y of the map upwards, that contains all poses with `margin` m around them. At most
/// `longest` px wide and high.
MapView viewFromAbove(const std::vector<urban_nav_core::Vector3d>& path, double margin, int longest);

/// Returns an oblique view of the path from outside and above.
MapView viewInPerspective(const std::vector<urban_nav_core::Vector3d>& path, int width, int height);

/// Part of a picture, px.
struct PictureBox {
  int u0 = 0, v0 = 0, width = 0, height = 0;
};

/// Draws points into a picture with a depth buffer and shading by normals. The picture does not depend on the order of
/// points, except for points of equal depth. Not thread-safe.
class MapPicture {
 public:
  explicit MapPicture(const MapView& view);
  void draw(const std::vector<MapPoint>& points);
  /// Draws a line on top of all points.
  void drawPath(const std::vector<urban_nav_core::Vector3d>& path);
  /// Returns the bounding box of the path and the points, with a margin. Up to 0.1 % of the points may lie beyond each
  /// side, so that single distant beams do not enlarge the picture.
  PictureBox shownBox() const;
  /// Fills small gaps between points, and returns the picture or the part within a box.
  urban_nav_registration::Picture finish() const { return finish({0, 0, view_.width, view_.height}); }
  urban_nav_registration::Picture finish(const PictureBox& box) const;
  /// Returns the same picture as red, green, blue and alpha in a byte each; alpha is 0 where nothing was drawn, else
  /// 255.
  std::vector<std::uint8_t> finishRgba(const PictureBox& box) const;

 private:
  struct Pixel {
    float depth = 0.0F;  ///< m; 0: empty
    float blue = 0.0F, green = 0.0F, red = 0.0F;
  };
  bool project(const urban_nav_core::Vector3d& p, double& u, double& v, double& depth) const;
  void put(int u, int v, const Pixel& pixel);
  void shadeEdges(std::vector<Pixel>& pixels) const;
  std::vector<Pixel> finishedPixels() const;

  const MapView view_;
  const urban_nav_core::Matrix3d R_;
  std::vector<Pixel> pixels_;
  std::vector<std::uint8_t> path_;  ///< 1 on the path
};

}  // namespace laser_mapper
