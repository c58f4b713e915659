// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "urban_nav_core/camera/pinhole.hpp"

namespace urban_nav_registration {

/// A position in an image, with depth.
struct ImagePoint {
  double u = 0.0, v = 0.0;  ///< px
  double depth = 0.0;       ///< m, along the line of sight
};

/// A point and the normal of its surface, in the frame of a camera; zero: unknown.
struct ViewedPoint {
  Eigen::Vector3d p, normal;
};

/// Minimum depth difference at which a point occludes another, so that a surface does not occlude itself.
struct DepthTolerance {
  float ahead = 0.1F, beside = 0.3F;  ///< m, along the line of sight, and in adjacent cells
  float share = 0.03F;                ///< additional, share of the distance
};

/// Depth of the nearest point along the lines of sight of an image, at a quarter of its resolution, for visibility
/// tests. Not thread-safe while points are added; isVisible() is.
class DepthMap {
 public:
  explicit DepthMap(const urban_nav_core::Pinhole& camera, const DepthTolerance& tolerance = {});
  /// Draws a point as a square with side `edge` (m).
  void add(const ImagePoint& at, double edge);
  /// Returns whether a point is not occluded, neither along its line of sight nor by much nearer points in adjacent
  /// cells. Points in the plane of the surface, such as the ground before it, do not occlude it.
  bool isVisible(const ImagePoint& at, const ViewedPoint& surface) const;

  /// Returns the number of cells.
  std::size_t size() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  /// Moves the depths out, to keep them elsewhere. The map must not be used before setCells().
  std::vector<float> takeCells() { return std::move(depth_); }
  /// Sets depths that takeCells() has returned; empty: no point is drawn.
  void setCells(std::vector<float> cells);

 private:
  bool isOnPlane(const ImagePoint& at, const ViewedPoint& surface, int u, int v, double front) const;

  const DepthTolerance tolerance_;
  int width_, height_;
  Eigen::Vector2d focal_;
  std::vector<float> depth_;  // m
};

}  // namespace urban_nav_registration
