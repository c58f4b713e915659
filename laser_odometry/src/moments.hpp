// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix3d;
using urban_nav_core::Vector3d;

/// Count, sum and sum of outer products of points, relative to an origin defined by the owner (m, m^2).
struct Moments {
  double count = 0.0;
  Vector3d sum = Vector3d::Zero();
  /// xx, xy, xz, yy, yz, zz.
  Eigen::Matrix<double, 6, 1> outer = Eigen::Matrix<double, 6, 1>::Zero();

  void add(const Vector3d& p) {
    count += 1.0;
    sum += p;
    outer[0] += p.x() * p.x();
    outer[1] += p.x() * p.y();
    outer[2] += p.x() * p.z();
    outer[3] += p.y() * p.y();
    outer[4] += p.y() * p.z();
    outer[5] += p.z() * p.z();
  }
  /// Adds `n` points with a mean and a covariance (m^2).
  void add(double n, const Vector3d& mean, const Matrix3d& covariance);
  /// Adds moments whose origin is at `shift` relative to this origin.
  void add(const Moments& other, const Vector3d& shift);
  /// Scales the weight of all points.
  void scale(double factor);

  Vector3d mean() const { return sum / count; }
  /// Returns the covariance of the points, divided by their count (m^2).
  Matrix3d covariance() const;

  void archive(urban_nav_core::Archive& archive) { archive(count, sum, outer); }
};

/// Variance of a range due to its resolution, m^2, which few points do not show.
constexpr double kBeamVariance = 0.01 * 0.01;

/// Plane through points.
struct Plane {
  bool usable = false;                  ///< enough points with a spread in two directions
  Vector3d mean = Vector3d::Zero();     ///< m
  Vector3d normal = Vector3d::UnitZ();  ///< unit
  double variance = 0.0;                ///< variance of the points along the normal, m^2
  Vector3d narrow = Vector3d::UnitX();  ///< unit, in the plane: direction of the smaller spread
  double width = 0.0;                   ///< variance of the points along `narrow`, m^2
  double length = 0.0;                  ///< variance of the points in the other direction of the plane, m^2
  double normal_variance = 0.0;         ///< variance of the normal in its least certain direction, rad^2
};

/// Returns whether a point is outside the extent of the plane's points, so that the plane would be extrapolated:
/// further than 2.5 standard deviations from their mean in a direction of the plane.
bool isOutside(const Plane& plane, const Vector3d& p);

/// Fits a plane to the moments, whose origin is `origin`. Not usable with fewer than six points, or if their spread
/// along the narrower direction of the plane is below 3.2 times that along the normal, as for a single line of beams.
Plane fitPlane(const Moments& moments, const Vector3d& origin);

/// Fits a plane parallel to z to the x and y of points, as of a wall cut by a horizontal scan. Not usable with fewer
/// than six points, or if they spread along the plane by less than 3.2 times their spread across it.
Plane fitWall(const Moments& moments, const Vector3d& origin);

}  // namespace laser_odometry
