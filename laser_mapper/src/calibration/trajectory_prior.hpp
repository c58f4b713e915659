// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/scan_places.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace laser_mapper {

/// Prior of the corrections of a trajectory at integer seconds, from odometry: a random walk from zero, each step with
/// the covariance of odometry and at least 1 mm and 0.3 mrad. Immutable, hence thread-safe.
class TrajectoryPrior {
 public:
  /// For `count` corrections at `begin`, one second later, and so on. `odometry`: null if unknown.
  TrajectoryPrior(const urban_nav_core::Trajectory& T_map_base, const urban_nav_core::OdometryChain* odometry,
                  urban_nav_core::StampNs begin, std::size_t count);

  std::size_t count() const { return steps_.size() + 1; }
  /// Adds the prior to the lower triangle of `information`, 6 rows for each correction, and to `gradient`.
  void addTo(const std::vector<PoseCorrection>& corrections, Eigen::MatrixXd& information,
             Eigen::VectorXd& gradient) const;
  /// Returns W^T H W with the information H of the prior.
  Eigen::MatrixXd transformed(const Eigen::MatrixXd& W) const;

 private:
  struct Step {
    urban_nav_core::Matrix6d carry = urban_nav_core::Matrix6d::Identity();  ///< from a correction to the next second
    urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Identity();
  };
  std::vector<Step> steps_;
};

}  // namespace laser_mapper
