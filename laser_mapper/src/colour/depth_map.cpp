// SPDX-License-Identifier: BSD-3-Clause
#include "colour/depth_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace laser_mapper {

using Eigen::Vector3d;

namespace {

constexpr double kNearest = 0.3;                              // m
constexpr int kReduction = 4;                                 // pixels of the image per pixel of the depth map
constexpr int kLargestPoint = 6;                              // px of the depth map
constexpr float kDepthTolerance = 0.1F, kDepthShare = 0.03F;  // m, and of the distance: a surface does not hide itself
constexpr float kEdgeTolerance = 0.3F;                        // m: an edge beside the line of sight
constexpr double kPlaneTolerance = 0.1;                       // m: how uneven a surface is

/// Tangent of the widest angle that an image shows along one axis, with 5 % to spare.
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

DepthMap::DepthMap(const ColourView& view)
    : width_((view.camera.pinhole.width + kReduction - 1) / kReduction),
      height_((view.camera.pinhole.height + kReduction - 1) / kReduction),
      focal_(view.camera.pinhole.fx, view.camera.pinhole.fy),
      depth_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
             std::numeric_limits<float>::infinity()) {}

void DepthMap::add(const ImagePoint& at, double edge, double focal) {
  const int size = std::clamp(static_cast<int>(std::ceil(edge * focal / (kReduction * at.depth))), 1, kLargestPoint);
  const int u0 = static_cast<int>(at.u / kReduction) - size / 2, v0 = static_cast<int>(at.v / kReduction) - size / 2;
  const auto depth = static_cast<float>(at.depth);
  for (int v = std::max(0, v0); v < std::min(height_, v0 + size); ++v)
    for (int u = std::max(0, u0); u < std::min(width_, u0 + size); ++u) {
      float& here =
          depth_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
      here = std::min(here, depth);
    }
}

bool DepthMap::isOnPlane(const ImagePoint& at, const ViewedPoint& surface, int u, int v, double front) const {
  if (surface.normal.squaredNorm() < 0.5) return false;
  const Eigen::Vector2d away(kReduction * (u + 0.5) - at.u, kReduction * (v + 0.5) - at.v);  // px, to the cell's middle
  const Vector3d ray = surface.p / surface.p.z() +
                       Vector3d(away.x() / focal_.x(), away.y() / focal_.y(), 0.0);  // the lens bends neighbours alike
  const double within_cell = 0.5 * kReduction / focal_.x() * front;
  return std::abs(surface.normal.dot(front * ray.normalized() - surface.p)) < kPlaneTolerance + within_cell;
}

bool DepthMap::isVisible(const ImagePoint& at, const ViewedPoint& surface) const {
  const int u0 = static_cast<int>(at.u / kReduction), v0 = static_cast<int>(at.v / kReduction);
  const auto depth = static_cast<float>(at.depth);
  for (int v = std::max(0, v0 - 1); v <= std::min(height_ - 1, v0 + 1); ++v)
    for (int u = std::max(0, u0 - 1); u <= std::min(width_ - 1, u0 + 1); ++u) {
      const float front =
          depth_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
      const bool here = u == u0 && v == v0;
      if (front < depth - (here ? kDepthTolerance : kEdgeTolerance) - kDepthShare * depth &&
          !isOnPlane(at, surface, u, v, static_cast<double>(front)))
        return false;
    }
  return true;
}

}  // namespace laser_mapper
