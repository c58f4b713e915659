// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "observability.hpp"
#include "patches.hpp"
#include "surface_map.hpp"
#include "sweep_points.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace laser_odometry {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

/// A patch of a sweep and its plane in the map.
struct PatchMatch {
  MapCell* cell = nullptr;
  double residual = 0.0;                 ///< distance of the patch from the plane, m
  double robust = 1.0;                   ///< factor of the robust kernel, 0...1
  double count = 0.0;                    ///< points of the patch
  PlaneRow row;                          ///< normal, lever and `weight` without the robust factor
  double time = 0.0, half_square = 0.0;  ///< times of the patch
  Vector3d p_odom = Vector3d::Zero();    ///< m
};

struct RegistrationOptions {
  MotionSpace space = MotionSpace::Spatial;
  int iterations = 12;
  double surface_sigma = 0.01;  ///< m
  int coarse_level = 0;         ///< finest level of the map used by the first steps
  /// Residuals expected in the first step from an error of the start pose, m (one sigma at the surfaces); reduced to a
  /// third with each step. Otherwise the many patches of the ground would make outliers of walls displaced by a wrong
  /// heading.
  double start_sigma = 0.1;
  /// Standard deviations of the twist and of the acceleration used for deskewing, for translation and rotation. Zero:
  /// both are exact.
  double velocity_sigma = 0.0, rate_sigma = 0.0;                      // m/s, rad/s
  double acceleration_sigma = 0.0, angular_acceleration_sigma = 0.0;  // m/s^2, rad/s^2
  /// Motion used for deskewing minus the predicted one, to which the standard deviations refer.
  SweepMotion motion_offset;
};

/// Result of a registration. Tangents as in PoseWithCovariance: parent frame odom.
struct Registration {
  Pose T_odom_base;
  SweepMotion motion_change;  ///< to be added to the motion used for deskewing
  /// Information of independent patches, with robust weights; the motion within the sweep is constrained by its
  /// prediction only.
  Matrix6d information = Matrix6d::Zero();
  FreeSubspace free;
  std::vector<PatchMatch> matches;
  double covered = 1.0;     ///< of the patches within 10 m, the share with a plane in the map
  double scale = 1.0;       ///< robust standard deviation of residual / sqrt(variance)
  double residual_m = 0.0;  ///< robust standard deviation of the residuals, m
  double share = 0.0;       ///< of the patches near surfaces of the map, those that match
  int iterations = 0;
  bool solved = false;  ///< false: too few matches for a solution; the pose is `start`
};

/// Registers patches to the map: point-to-plane with the variance of each plane, Cauchy kernel at the observed spread.
/// Starts at `start`; estimates the motion within the sweep jointly with the pose. Unconstrained directions are taken
/// from `prior`; coordinates outside of the space remain those of `start`. Updates outdated planes of the map.
Registration registerPatches(const std::vector<Patch>& patches, SurfaceMap& map, const Pose& prior, const Pose& start,
                             const RegistrationOptions& options);

/// Returns the matches of the patches at a pose, in their order, without robust factors. `motion_change`: as in
/// Registration.
std::vector<PatchMatch> matchPatches(const std::vector<Patch>& patches, SurfaceMap& map, const Pose& T_odom_base,
                                     const SweepMotion& motion_change, double surface_sigma, int level);

}  // namespace laser_odometry
