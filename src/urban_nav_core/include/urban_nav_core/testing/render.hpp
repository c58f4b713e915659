// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/testing/scene.hpp"

namespace urban_nav_core::testing {

/// Camera of the renderer: an exact pinhole with integer pixel centres, z forward, x right, y down. It has its own
/// projection, so that camera/ can be tested against it.
struct RenderCamera {
  double fx = 400.0, fy = 400.0;  ///< px
  double cx = 255.5, cy = 191.5;  ///< px
  int width = 512, height = 384;  ///< px
  double baseline = 0.12;         ///< m, of the right camera along x
  double blur = 0.5;  ///< standard deviation of the point spread function, px: a good lens with a pixel's area
};

/// Draws a scene. Keeps its buffers, so one renderer should draw many frames. Not thread-safe; different renderers are
/// independent.
class Renderer {
 public:
  explicit Renderer(const RenderCamera& camera);

  const RenderCamera& camera() const { return camera_; }
  /// Returns the image of a camera at T_world_camera: grey levels, neither rounded nor clipped, row by row. Valid until
  /// the next call.
  const std::vector<float>& draw(const Scene& scene, const Pose& T_world_camera);

 private:
  /// Rectangle in the camera frame: (a, b, 1) / z = N (u, v, 1), including texture coordinates.
  struct Plane {
    Eigen::Matrix3d N;
    double a0, a1, b0, b1;  ///< bounds in texture coordinates
    const Texture* texture;
    double shade;
  };

  /// Texture coordinates of a pixel, m, and the factor from N (u, v, 1) to its depth.
  struct Place {
    double a, b, scale;
  };

  void place(const Scene& scene, const Pose& T_world_camera);
  void claim(int plane);
  static Place placeAt(const Plane& plane, double u, double v);
  static Texture::Filter filterAt(const Plane& plane, double u, double v, double blur);
  static const Plane* nearest(const std::vector<const Plane*>& planes, const Eigen::Vector3d& pixel);
  std::vector<const Plane*> planesAbout(int u, int v) const;
  int ownerAt(int u, int v) const;
  void drawRow(int v);
  bool drawRun(int u0, int v);
  float* pixel(int u, int v);
  double blend(int u, int v) const;
  bool isBorder(int u, int v) const;

  RenderCamera camera_;
  double background_ = 0.0;
  std::vector<double> point_weights_;  ///< of the points of a pixel where planes meet
  std::vector<Plane> planes_;
  std::vector<int> owner_;  ///< plane of each pixel's centre, -1: none
  std::vector<float> inverse_z_;
  std::vector<float> image_;
};

}  // namespace urban_nav_core::testing
