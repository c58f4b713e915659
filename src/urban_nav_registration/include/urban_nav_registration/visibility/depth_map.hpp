// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/camera/pinhole.hpp"

namespace urban_nav_registration {

/// A place in an image.
struct ImagePoint {
  double u = 0.0, v = 0.0;  ///< px
  double depth = 0.0;       ///< m, along the line of sight
};

/// A point and the normal of its surface, in the frame of a camera; zero: unknown.
struct ViewedPoint {
  Eigen::Vector3d p, normal;
};

/// How much nearer than a point something must be to hide it: a surface does not hide itself.
struct DepthTolerance {
  float ahead = 0.1F, beside = 0.3F;  ///< m, on the line of sight, and in the cells beside it
  float share = 0.03F;                ///< of the distance, in addition
};

/// The distance of the nearest point along the lines of sight of an image, at a quarter of its resolution: which points
/// an image shows. Not thread-safe while points are added; isVisible() is.
class DepthMap {
 public:
  explicit DepthMap(const urban_nav_core::Pinhole& camera, const DepthTolerance& tolerance = {});
  /// Draws a point that is `edge` (m) wide.
  void add(const ImagePoint& at, double edge);
  /// Returns whether nothing is in front of a point, nor beside its line of sight and much nearer. What lies on the
  /// plane of the point, such as the ground before it, is not in front of it.
  bool isVisible(const ImagePoint& at, const ViewedPoint& surface) const;

 private:
  bool isOnPlane(const ImagePoint& at, const ViewedPoint& surface, int u, int v, double front) const;

  const DepthTolerance tolerance_;
  int width_, height_;
  Eigen::Vector2d focal_;
  std::vector<float> depth_;  // m
};

}  // namespace urban_nav_registration
