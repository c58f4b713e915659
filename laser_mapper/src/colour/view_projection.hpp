// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "laser_mapper/colour/colour_view.hpp"
#include "laser_mapper/map_point.hpp"
#include "urban_nav_registration/visibility/depth_map.hpp"

namespace laser_mapper {

/// Largest distance at which a view colours a point, m.
constexpr double kColourDistance = 20.0;

/// Projects points into a view, with a quick rejection before the lens model.
class ViewProjection {
 public:
  explicit ViewProjection(const ColourView& view);
  /// Returns nullopt for points outside the image, nearer than 0.3 m or farther than kColourDistance.
  std::optional<urban_nav_registration::ImagePoint> project(const Eigen::Vector3f& p) const;
  /// Returns a point of the map and its normal, in the camera's frame.
  urban_nav_registration::ViewedPoint toCamera(const MapPoint& point) const;
  /// Returns whether a box of the map may contain visible points.
  bool mayObserve(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;
  const Eigen::Vector3d& centre() const { return centre_; }
  double focal() const { return view_.camera.pinhole.fx; }
  const ColourView& view() const { return view_; }

 private:
  const ColourView& view_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d t_, centre_;
  double tangent_x_ = 0.0, tangent_y_ = 0.0;  ///< of half the fields of view, with a margin for distortion
};

}  // namespace laser_mapper
