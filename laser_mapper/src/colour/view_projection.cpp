// SPDX-License-Identifier: BSD-3-Clause
#include "colour/view_projection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_registration::ImagePoint;
using urban_nav_registration::ViewedPoint;

namespace {

constexpr double kNearest = 0.3;  // m

/// Returns the tangent of half the field of view along one axis, with a margin of 5 %.
double widestTangent(const urban_nav_core::RawCamera& camera, bool horizontal) {
  const urban_nav_core::Pinhole& pinhole = camera.pinhole;
  double widest = 0.0;
  for (const double u : {0.0, 0.5, 1.0})
    for (const double v : {0.0, 0.5, 1.0})
      if (const auto ray = camera.ray({u * (pinhole.width - 1), v * (pinhole.height - 1)}))
        widest = std::max(widest, std::abs(horizontal ? ray->x() : ray->y()));
  return 1.05 * (widest > 0.0 ? widest : 3.0);
}

}  // namespace

ViewProjection::ViewProjection(const ColourView& view)
    : view_(view),
      R_(view.T_map_camera.inverse().R()),
      t_(view.T_map_camera.inverse().t()),
      centre_(view.T_map_camera.t()),
      tangent_x_(widestTangent(view.camera, true)),
      tangent_y_(widestTangent(view.camera, false)) {}

bool ViewProjection::mayObserve(const Vector3d& low, const Vector3d& high) const {
  const Vector3d nearest = centre_.cwiseMax(low).cwiseMin(high);
  return (nearest - centre_).squaredNorm() < kColourDistance * kColourDistance;
}

std::optional<ImagePoint> ViewProjection::project(const Eigen::Vector3f& p) const {
  const Vector3d q = R_ * p.cast<double>() + t_;
  if (q.z() < kNearest || std::abs(q.x()) > tangent_x_ * q.z() || std::abs(q.y()) > tangent_y_ * q.z())
    return std::nullopt;
  const double depth = q.norm();
  if (depth > kColourDistance) return std::nullopt;
  const auto pixel = view_.camera.project(q);
  if (!pixel || !view_.camera.pinhole.contains(*pixel)) return std::nullopt;
  return ImagePoint{pixel->x(), pixel->y(), depth};
}

ViewedPoint ViewProjection::toCamera(const MapPoint& point) const {
  return {R_ * point.p.cast<double>() + t_, R_ * point.normal.cast<double>()};
}

}  // namespace laser_mapper
