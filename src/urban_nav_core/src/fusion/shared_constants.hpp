// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fusion/interval_motion.hpp"
#include "urban_nav_core/fusion/fuse_odometry.hpp"

namespace urban_nav_core {

/// Interval in which both odometries measured the motion.
struct Stretch {
  std::size_t first_step = 0, end_step = 0;  ///< [first, end) in the stereo chain
  StampNs from = 0, to = 0;
  IntervalMotion stereo, laser;
  double statistic = 0.0;  ///< squared Mahalanobis distance at the estimated constants
};

/// Constants common to both odometries: rotation of the LiDAR's mounting (3), those of the stereo chain, those of the
/// laser chain; with their joint estimate from all intervals.
class SharedConstants {
 public:
  /// Estimates the constants by least squares with priors, with robust weights for conflicting intervals, and sets the
  /// statistics of the intervals.
  SharedConstants(std::vector<Stretch>& stretches, const std::vector<RelativePose>& stereo,
                  const std::vector<RelativePose>& laser, const Vector3d& p_base_lidar, const FusionOptions& options);

  /// Returns the stereo motion corrected by the estimated constants; its Jacobian by the constants is separate.
  Pose correctedStereo(const IntervalMotion& motion) const;
  Eigen::MatrixXd stereoSensitivity(const IntervalMotion& motion) const;
  /// Returns the laser motion corrected by the estimated constants; its Jacobian by the constants is separate.
  Pose correctedLaser(const IntervalMotion& motion) const;
  Eigen::MatrixXd laserSensitivity(const IntervalMotion& motion) const;

  /// Return L with L L^T equal to the joint covariance of the constants.
  const Eigen::MatrixXd& factor() const { return factor_; }
  /// Returns the mean squared distance per degree of freedom, at least 1.
  double spread() const { return spread_; }
  std::vector<SharedConstant> list() const;

 private:
  void addPriors(const std::vector<RelativePose>& steps, double scale_sigma);
  std::optional<std::size_t> index(const std::string& name) const;
  Pose applyConstants(const IntervalMotion& motion, const Pose& measured) const;
  void addConstants(const IntervalMotion& motion, Eigen::MatrixXd& sensitivity) const;
  void estimate(std::vector<Stretch>& stretches);
  /// Keeps the given mounting, with the posterior uncertainty of the comparison, unless the comparison contradicts it.
  void keepMounting(std::vector<Stretch>& stretches);

  Vector3d p_base_lidar_;
  std::vector<std::string> names_;
  Eigen::VectorXd prior_, prior_sigma_, value_;
  Eigen::MatrixXd covariance_, factor_;
  Eigen::VectorXd measured_;  ///< estimate before the mounting was fixed
  bool keeps_mounting_ = false;
  double spread_ = 1.0;
};

}  // namespace urban_nav_core
