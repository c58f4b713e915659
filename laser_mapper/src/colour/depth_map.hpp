// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "laser_mapper/colour/colour_view.hpp"
#include "laser_mapper/map_point.hpp"

namespace laser_mapper {

/// Farthest point that a view colours, m.
constexpr double kColourDistance = 20.0;

/// A point and the normal of its surface; zero: unknown.
struct ViewedPoint {
  Eigen::Vector3d p, normal;
};

/// Projects points into a view: a quick test for those outside, then the lens.
class ViewProjection {
 public:
  explicit ViewProjection(const ColourView& view);
  /// Returns nullopt for points outside the image, nearer than 0.3 m or farther than kColourDistance.
  std::optional<ImagePoint> project(const Eigen::Vector3f& p) const;
  /// Returns a point of the map and its normal, in the camera's frame.
  ViewedPoint toCamera(const MapPoint& point) const;
  /// Returns whether a box of the map may hold such points.
  bool mayObserve(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;
  const Eigen::Vector3d& centre() const { return centre_; }
  double focal() const { return view_.camera.pinhole.fx; }
  const ColourView& view() const { return view_; }

 private:
  const ColourView& view_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d t_, centre_;
  double tangent_x_ = 0.0, tangent_y_ = 0.0;  ///< of half the fields of view, with room for the lens
};

/// The distance of the nearest point of the map along the lines of sight of a view, at a quarter of its resolution.
class DepthMap {
 public:
  explicit DepthMap(const ColourView& view);
  /// Draws a point of the map that is `edge` (m) wide.
  void add(const ImagePoint& at, double edge, double focal);
  /// Returns whether nothing of the map is in front of a point, nor beside its line of sight and much nearer. What lies
  /// on the plane of the point, such as the ground on the way to it, is not in front of it.
  bool isVisible(const ImagePoint& at, const ViewedPoint& surface) const;

 private:
  bool isOnPlane(const ImagePoint& at, const ViewedPoint& surface, int u, int v, double front) const;

  int width_, height_;
  Eigen::Vector2d focal_;
  std::vector<float> depth_;  ///< m
};

}  // namespace laser_mapper
