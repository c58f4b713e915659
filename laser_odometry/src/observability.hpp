// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

/// A point on a plane as observability sees it.
struct PlaneRow {
  urban_nav_core::Vector3d normal = urban_nav_core::Vector3d::UnitZ();  ///< unit
  urban_nav_core::Vector3d lever = urban_nav_core::Vector3d::Zero();    ///< from the base to the point, in odom, m
  double normal_sigma = 0.0;                                            ///< standard deviation of the normal, rad
  double weight = 0.0;                                                  ///< 1/m^2

  /// Returns the derivative of the distance from the plane (tangent as in PoseWithCovariance).
  Vector6d jacobian() const;
};

/// The directions of a pose that measurements leave free. Rotations count by `lever`, m: the tangent (rho, lever phi).
struct FreeSubspace {
  double lever = 1.0;                ///< root mean square lever of the rotations, m
  std::vector<Vector6d> directions;  ///< orthonormal, scaled tangent (m)
  std::vector<double> evidence;      ///< effective number of patches of all six directions, weakest first

  bool isFree() const { return !directions.empty(); }
  /// Returns whether one of the directions is rather a translation than a rotation.
  bool leavesPositionFree() const;
  /// Returns (rho, lever phi) and back.
  Vector6d scaled(const Vector6d& d) const;
  Vector6d unscaled(const Vector6d& d) const;
};

/// Finds the directions along which fewer than a handful of patches hold the pose. A patch counts along a direction
/// only if its plane is across the displacement by more than its normal may err: noise of the normals is no
/// information (docs/derivations/laser_odometry.md). Invariant to the scale of the weights.
FreeSubspace findFreeSubspace(const std::vector<PlaneRow>& rows);

/// Solves H d = g in the observed directions alone; `along_free`: what d is along the free ones (unscaled tangent).
Vector6d solveObserved(const Matrix6d& H, const Vector6d& g, const FreeSubspace& free, const Vector6d& along_free);

/// Returns the covariance: the inverse of H in the observed directions, that of `prior` along the free ones.
Matrix6d covarianceOfObserved(const Matrix6d& H, const FreeSubspace& free, const Matrix6d& prior);

}  // namespace laser_odometry
