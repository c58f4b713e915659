// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "motion_space.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

/// Linearised point-to-plane measurement.
struct PlaneRow {
  urban_nav_core::Vector3d normal = urban_nav_core::Vector3d::UnitZ();  ///< unit
  urban_nav_core::Vector3d lever = urban_nav_core::Vector3d::Zero();    ///< from the base to the point, in odom, m
  double normal_sigma = 0.0;                                            ///< standard deviation of the normal, rad
  double weight = 0.0;                                                  ///< 1/m^2

  /// Returns the derivative of the distance from the plane (tangent as in PoseWithCovariance).
  Vector6d jacobian() const;
};

/// Unobserved directions of a pose. Rotations are scaled by `lever`, m: tangent (rho, lever phi).
struct FreeSubspace {
  /// Root mean square lever of the rotations, m; of planar motion, distance of the patches.
  double lever = 1.0;
  std::vector<Vector6d> directions;          ///< orthonormal, scaled tangent (m)
  std::vector<double> evidence;              ///< effective number of patches of all estimated directions, weakest first
  MotionSpace space = MotionSpace::Spatial;  ///< coordinates outside of it are neither free nor observed

  bool isFree() const { return !directions.empty(); }
  /// Returns whether one of the directions is mainly a translation.
  bool leavesPositionFree() const;
  /// Conversions to and from (rho, lever phi).
  Vector6d scaled(const Vector6d& d) const;
  Vector6d unscaled(const Vector6d& d) const;
};

/// Finds the directions constrained by fewer than a handful of patches. A patch constrains a direction only if the
/// angle between its plane and the displacement exceeds the uncertainty of its normal: noise of the normals is not
/// information (docs/derivations/laser_odometry.md). Invariant to the scale of the weights.
FreeSubspace findFreeSubspace(const std::vector<PlaneRow>& rows, MotionSpace space = MotionSpace::Spatial);

/// Solves H d = g in the observed directions; `along_free`: d along the free ones (unscaled tangent). Zero outside of
/// the space.
Vector6d solveObserved(const Matrix6d& H, const Vector6d& g, const FreeSubspace& free, const Vector6d& along_free);

/// Returns the covariance: inverse of H in the observed directions, `prior` along the free ones, zero outside of the
/// space.
Matrix6d covarianceOfObserved(const Matrix6d& H, const FreeSubspace& free, const Matrix6d& prior);

}  // namespace laser_odometry
