// SPDX-License-Identifier: BSD-3-Clause
#include "lidar/lidar_pattern.hpp"

#include <cassert>
#include <cmath>

namespace urban_nav_sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRadiansPerDegree = M_PI / 180.0;
constexpr int kColumnsOfTurn = 2000, kColumnsOfRosette = 4000;
constexpr double kPrism = 0.5 * 35.2 * kRadiansPerDegree;                    // deflection by one prism, rad
constexpr double kFirstPrism = 7294.0 / 60.0, kSecondPrism = 4664.0 / 60.0;  // turns per second
constexpr double kLineSpacing = 0.42 * kRadiansPerDegree;

double fraction(double turns) { return turns - std::floor(turns); }

/// Returns the direction after two thin prisms, whose deflections add as vectors across the axis.
Vector3d rosetteDirection(double t) {
  const double first = 2.0 * M_PI * fraction(kFirstPrism * t), second = -2.0 * M_PI * fraction(kSecondPrism * t);
  const Vector2d across =
      kPrism * (Vector2d(std::cos(first), std::sin(first)) + Vector2d(std::cos(second), std::sin(second)));
  const double angle = across.norm();
  if (angle < 1e-12) return Vector3d::UnitX();
  const Vector2d aside = std::sin(angle) / angle * across;
  return {std::cos(angle), aside.x(), aside.y()};
}

}  // namespace

LidarPattern::LidarPattern(const LidarModel& model)
    : pattern_(model.pattern),
      rings_(model.rings),
      columns_(model.pattern == LidarModel::Pattern::Rings ? kColumnsOfTurn : kColumnsOfRosette) {
  assert(rings_ > 0);
}

double LidarPattern::time(int column, int ring) const {
  return kPeriod * (column + static_cast<double>(ring) / rings_) / columns_;
}

double LidarPattern::elevation(int ring) const {
  if (pattern_ == LidarModel::Pattern::Rosette) return kLineSpacing * (ring - 0.5 * (rings_ - 1));
  if (rings_ == 1) return 0.0;
  const double low = rings_ < 32 ? -15.0 * kRadiansPerDegree : -25.0 * kRadiansPerDegree,
               high = 15.0 * kRadiansPerDegree;
  return low + (high - low) * ring / (rings_ - 1);
}

Vector3d LidarPattern::direction(std::uint64_t sweep, int column, int ring, double elevation_error) const {
  const double elevation = this->elevation(ring) + elevation_error, t = time(column, ring);
  const double up = std::sin(elevation), level = std::cos(elevation);
  if (pattern_ == LidarModel::Pattern::Rings) {
    const double azimuth = M_PI - 2.0 * M_PI * t / kPeriod;
    return {level * std::cos(azimuth), level * std::sin(azimuth), up};
  }
  const Vector3d d = rosetteDirection(static_cast<double>(sweep) * kPeriod + t);
  return {level * d.x() - up * d.z(), d.y(), up * d.x() + level * d.z()};
}

}  // namespace urban_nav_sim
