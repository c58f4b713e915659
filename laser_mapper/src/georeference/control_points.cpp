// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/georeference/control_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/level_motion.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace laser_mapper {

using Eigen::Vector2d;
using Eigen::Vector3d;
using urban_nav_core::LocalTangent;

namespace {

constexpr double kLeastControlExtent = 0.1;  // m, root mean square distance from the centre
constexpr double kLargestResidual =
    0.1;  // relative to the extent: ten times the errors of length of a map by odometry alone

/// Returns the root mean square horizontal distance from the centre.
double horizontalExtent(const std::vector<Vector3d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector3d& p : points) mean += p.head<2>() / static_cast<double>(points.size());
  double squares = 0.0;
  for (const Vector3d& p : points) squares += (p.head<2>() - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(points.size()));
}

/// Returns the sentence for points that do not fit.
std::string shapeReason(const std::vector<ControlPoint>& points, const std::vector<double>& errors) {
  const std::size_t worst = static_cast<std::size_t>(std::max_element(errors.begin(), errors.end()) - errors.begin());
  return "the map has another shape than the surveyed points: " + points[worst].name + " is " +
         urban_nav_core::formatNumber(errors[worst], 3) + " m from its position";
}

}  // namespace

ControlFit fitControlPoints(const std::vector<ControlPoint>& points) {
  ControlFit result;
  if (points.size() < 2) {
    result.fit.reason = std::to_string(points.size()) + " surveyed points, 2 are needed";
    return result;
  }
  const auto n = static_cast<double>(points.size());
  GeoReference reference;
  reference.origin = points.front().surveyed;
  const LocalTangent tangent(reference.origin);
  std::vector<Vector3d> in_map, local;
  for (const ControlPoint& point : points) {
    in_map.push_back(point.p_map);
    local.push_back(tangent.toLocal(point.surveyed));
  }
  const double extent = std::min(horizontalExtent(in_map), horizontalExtent(local));
  if (extent < kLeastControlExtent) {
    result.fit.reason = "all surveyed points are at one place: the heading is unknown";
    return result;
  }
  const urban_nav_core::LevelMotion fit =
      urban_nav_core::fitLevelMotion(in_map, local, std::vector<double>(points.size(), 1.0));
  double squares = 0.0, height_squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d error = fit * in_map[i] - local[i];
    result.errors.push_back(error.head<2>().norm());
    squares += error.head<2>().squaredNorm();
    height_squares += error.z() * error.z();
  }
  if (std::sqrt(squares / n) > kLargestResidual * extent) {
    result.fit.reason = shapeReason(points, result.errors);
    return result;
  }
  reference.T_local_map =
      urban_nav_core::Pose(Eigen::Quaterniond(Eigen::AngleAxisd(fit.yaw, Vector3d::UnitZ())), fit.shift);
  reference.fixes = points.size();
  std::vector<double> errors = result.errors;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  reference.residual = errors[errors.size() / 2];
  const double sigma = std::sqrt(squares / (2.0 * n - 3.0));  // two coordinates a point, three unknowns
  reference.position_sigma = sigma / std::sqrt(n);
  reference.height_sigma = std::sqrt(height_squares / (n - 1.0) / n);
  reference.heading_sigma = sigma / (extent * std::sqrt(n));
  result.fit.reference = reference;
  return result;
}

}  // namespace laser_mapper
