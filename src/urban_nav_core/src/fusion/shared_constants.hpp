// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fusion/interval_motion.hpp"
#include "urban_nav_core/fusion/fuse_odometry.hpp"

namespace urban_nav_core {

/// A stretch in which both odometries measured the same motion.
struct Stretch {
  std::size_t first_step = 0, end_step = 0;  ///< [first, end) in the stereo chain
  StampNs from = 0, to = 0;
  IntervalMotion stereo, laser;
  double statistic = 0.0;  ///< squared Mahalanobis distance after the constants are known
};

/// The constants that both odometries share: rotation of the LiDAR's mounting (3), those of the stereo chain, those of
/// the laser chain, with their joint estimate from all stretches.
class SharedConstants {
 public:
  /// Estimates the constants by least squares with priors, stretches in conflict weighted down, and sets their
  /// statistics.
  SharedConstants(std::vector<Stretch>& stretches, const std::vector<RelativePose>& stereo,
                  const std::vector<RelativePose>& laser, const Vector3d& p_base_lidar, const FusionOptions& options);

  /// Returns the motion by stereo with the estimated constants, and its change per constant.
  Pose correctedStereo(const IntervalMotion& motion) const;
  Eigen::MatrixXd stereoSensitivity(const IntervalMotion& motion) const;
  /// The same two for the laser.
  Pose correctedLaser(const IntervalMotion& motion) const;
  Eigen::MatrixXd laserSensitivity(const IntervalMotion& motion) const;

  /// Joint covariance of the constants, and L with L L^T equal to it.
  const Eigen::MatrixXd& factor() const { return factor_; }
  /// Mean squared distance over degrees of freedom, at least 1.
  double spread() const { return spread_; }
  std::vector<SharedConstant> list() const;

 private:
  void addPriors(const std::vector<RelativePose>& steps, double scale_sigma);
  std::optional<std::size_t> index(const std::string& name) const;
  Pose applyConstants(const IntervalMotion& motion, const Pose& measured) const;
  void addConstants(const IntervalMotion& motion, Eigen::MatrixXd& sensitivity) const;
  void estimate(std::vector<Stretch>& stretches);
  /// Keeps the mounting as given, with the uncertainty that the comparison leaves it, unless that contradicts it.
  void keepMounting(std::vector<Stretch>& stretches);

  Vector3d p_base_lidar_;
  std::vector<std::string> names_;
  Eigen::VectorXd prior_, prior_sigma_, value_;
  Eigen::MatrixXd covariance_, factor_;
  Eigen::VectorXd measured_;  ///< before the mounting was kept
  bool keeps_mounting_ = false;
  double spread_ = 1.0;
};

}  // namespace urban_nav_core
