// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/visibility/depth_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace urban_nav_registration {

using Eigen::Vector3d;

namespace {

constexpr int kReduction = 4;             // pixels of the image per pixel of the depth map
constexpr int kLargestPoint = 6;          // px of the depth map
constexpr double kPlaneUnevenness = 0.1;  // m

}  // namespace

DepthMap::DepthMap(const urban_nav_core::Pinhole& camera, const DepthTolerance& tolerance)
    : tolerance_(tolerance),
      width_((camera.width + kReduction - 1) / kReduction),
      height_((camera.height + kReduction - 1) / kReduction),
      focal_(camera.fx, camera.fy),
      depth_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
             std::numeric_limits<float>::infinity()) {}

void DepthMap::setCells(std::vector<float> cells) {
  if (cells.empty()) cells.assign(size(), std::numeric_limits<float>::infinity());
  depth_ = std::move(cells);
}

void DepthMap::add(const ImagePoint& at, double edge) {
  const int size =
      std::clamp(static_cast<int>(std::ceil(edge * focal_.x() / (kReduction * at.depth))), 1, kLargestPoint);
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
  const Eigen::Vector2d away(kReduction * (u + 0.5) - at.u, kReduction * (v + 0.5) - at.v);  // px, to the centre of the
                                                                                             // cell
  const Vector3d ray = surface.p / surface.p.z() +
                       Vector3d(away.x() / focal_.x(), away.y() / focal_.y(), 0.0);  // the distortion of neighbouring
                                                                                     // pixels is similar
  const double within_cell = 0.5 * kReduction / focal_.x() * front;
  return std::abs(surface.normal.dot(front * ray.normalized() - surface.p)) < kPlaneUnevenness + within_cell;
}

bool DepthMap::isVisible(const ImagePoint& at, const ViewedPoint& surface) const {
  const int u0 = static_cast<int>(at.u / kReduction), v0 = static_cast<int>(at.v / kReduction);
  const auto depth = static_cast<float>(at.depth);
  for (int v = std::max(0, v0 - 1); v <= std::min(height_ - 1, v0 + 1); ++v)
    for (int u = std::max(0, u0 - 1); u <= std::min(width_ - 1, u0 + 1); ++u) {
      const float front =
          depth_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
      const float tolerance = u == u0 && v == v0 ? tolerance_.ahead : tolerance_.beside;
      if (front < depth - tolerance - tolerance_.share * depth &&
          !isOnPlane(at, surface, u, v, static_cast<double>(front)))
        return false;
    }
  return true;
}

}  // namespace urban_nav_registration
