// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "laser_mapper/quality/odometry_drift.hpp"
#include "laser_mapper/quality/plane_place.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Normal of a plane and two unit vectors along it, right-handed.
struct PlaneAxes {
  Eigen::Vector3d normal, first, second;
};

/// Effect of odometry drift around a reference pose on planes observed around it.
///
/// The error of the trajectory is a random walk that is zero at the reference pose, with independent steps of 0.25 s in
/// both directions of time and the covariance that odometry states per second. A step (rho, phi) at time s and position
/// t moves points p observed later by rho + phi x (p - t); if s lies before the reference, it moves points observed
/// before s by the opposite. Immutable, hence thread-safe.
class StretchWalk {
 public:
  /// Covers the times from `begin` to `end`, which include the reference pose; without a drift there are no steps.
  /// Requires a non-empty trajectory.
  StretchWalk(const urban_nav_core::Trajectory& T_map_base, urban_nav_core::StampNs reference,
              urban_nav_core::StampNs begin, urban_nav_core::StampNs end, const OdometryDrift* drift);

  /// Returns the number of columns of rows().
  Eigen::Index size() const { return 6 * static_cast<Eigen::Index>(steps_.size()); }

  /// Returns the linear map from independent unit errors to a patch's displacement along the normal, m, and its
  /// rotation about the two axes along it, rad: 3 x size(). The patch is observed uniformly over sqrt(12) times its
  /// stamp_spread. If its cells are observed one after another (PlanePatch::sweep), a growing displacement appears as a
  /// tilt.
  Eigen::MatrixXd rows(const PlanePatch& patch, const PlaneAxes& axes) const;

 private:
  struct Step {
    double begin = 0.0;             ///< s, relative to the reference
    Eigen::Vector3d t;              ///< m, position of the robot in the map
    urban_nav_core::Matrix6d root;  ///< factor of independent unit errors: (rho, phi), in the axes of the map
  };
  const urban_nav_core::StampNs reference_;
  std::vector<Step> steps_;
};

}  // namespace laser_mapper
