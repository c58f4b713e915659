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

/// What the drift of odometry around a reference pose does to planes that are seen meanwhile.
///
/// The error of the trajectory is a random walk that is zero at the reference pose and has independent steps of 0.25 s
/// in both directions of time, with the covariance that odometry states per second. A step (rho, phi) at time s and
/// place t moves points p that are seen later by rho + phi x (p - t), and those seen before s, if s lies before the
/// reference, by the opposite. Immutable, so thread-safe.
class StretchWalk {
 public:
  /// Covers the times from `begin` to `end`, which include the reference pose; without a drift there are no steps. The
  /// trajectory must not be empty.
  StretchWalk(const urban_nav_core::Trajectory& T_map_base, urban_nav_core::StampNs reference,
              urban_nav_core::StampNs begin, urban_nav_core::StampNs end, const OdometryDrift* drift);

  /// Returns the columns of rows().
  Eigen::Index size() const { return 6 * static_cast<Eigen::Index>(steps_.size()); }

  /// Returns the linear map from independent unit errors to a patch's displacement along the normal, m, and its turn
  /// about the two axes along it, rad: 3 x size(). The patch is seen evenly over sqrt(12) times its stamp_spread. Where
  /// its cells are seen one after another (PlanePatch::sweep), a plane that is displaced more and more looks tilted.
  Eigen::MatrixXd rows(const PlanePatch& patch, const PlaneAxes& axes) const;

 private:
  struct Step {
    double begin = 0.0;             ///< s, from the reference
    Eigen::Vector3d t;              ///< m, where the robot is, in the map
    urban_nav_core::Matrix6d root;  ///< times independent unit errors: (rho, phi), in the axes of the map
  };
  const urban_nav_core::StampNs reference_;
  std::vector<Step> steps_;
};

}  // namespace laser_mapper
