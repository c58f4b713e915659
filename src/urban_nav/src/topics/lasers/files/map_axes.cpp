// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/map_axes.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace urban_nav {

using laser_mapper::MapPoint;
using urban_nav_core::Vector3d;

namespace {

constexpr double kScaleBase = 10.0;  // m: long compared with rounding, short compared with the curvature of the earth

}  // namespace

MapAxes::MapAxes(const MapCrs* crs, const std::vector<Vector3d>& path) : crs_(crs) {
  if (crs == nullptr) return;
  const Vector3d start = path.empty() ? Vector3d::Zero() : path.front();
  const Vector3d from = crs->project(start), along = crs->project(start + Vector3d(kScaleBase, 0.0, 0.0)) - from;
  offset_ = from.array().round();
  scale_ = along.head<2>().norm() / kScaleBase;
  turn_ = Eigen::AngleAxisf(static_cast<float>(std::atan2(along.y(), along.x())), Eigen::Vector3f::UnitZ())
              .toRotationMatrix();
}

Vector3d MapAxes::place(const Vector3d& p_map) const {
  return crs_ == nullptr ? p_map : Vector3d(crs_->project(p_map) - offset_);
}

std::vector<Vector3d> MapAxes::place(const std::vector<Vector3d>& path) const {
  std::vector<Vector3d> placed;
  placed.reserve(path.size());
  for (const Vector3d& p : path) placed.push_back(place(p));
  return placed;
}

MapPoint MapAxes::place(const MapPoint& point) const {
  if (crs_ == nullptr) return point;
  MapPoint placed = point;
  placed.p = place(Vector3d(point.p.cast<double>())).cast<float>();
  placed.normal = turn_ * point.normal;
  return placed;
}

const std::vector<MapPoint>& MapAxes::place(const std::vector<MapPoint>& points, std::vector<MapPoint>& buffer) const {
  if (crs_ == nullptr) return points;
  buffer.clear();
  for (const MapPoint& point : points) buffer.push_back(place(point));
  return buffer;
}

Vector3d MapAxes::toMap(const Vector3d& p) const { return crs_ == nullptr ? p : crs_->unproject(p + offset_); }

}  // namespace urban_nav
