// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/io/archive.hpp"
#include "window/drift_sandwich.hpp"
#include "window/prior.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Estimate of the disparity offset, px.
struct DisparityOffsetEstimate {
  double used = 0.0;                  ///< the estimate used by the poses
  double mean = 0.0, variance = 0.0;  ///< posterior of the true offset
  /// Mean square of the error of the estimate.
  double error() const { return variance + (mean - used) * (mean - used); }
};

/// Information on the position and orientation of the window in `odom` (gauge).
///
/// All measurements are relative, and with first-estimate Jacobians they carry no information in the six gauge
/// directions G. Therefore Pi G is the remainder of the prior of the first pose:
///   Pi = Pi_relative + v M v^T, Pi_relative G = 0, M = G^T Pi G, v = Pi G M^-1,
/// with M the information on gamma = v^T x, the pose of the window as a whole given its shape. Neither the estimate nor
/// the covariance of the shape depends on M; the covariance of a block is that of the shape plus G_b M^-1 G_b^T. Hence
///
/// * M may be replaced by a stronger W at any time, with M^-1 - W^-1 carried separately, without changing any result:
/// rounding does not erode the information relative to the first pose, and Gauss-Newton has no weak direction
/// (fixGauge);
/// * marginalisation can only reduce M, and the growth of M^-1 is the drift of the step: the part of its error that no
/// later measurement corrects (growth). It is positive semidefinite, and the drift between two poses is the sum of the
/// drifts of the steps.
///
/// Derivation: docs/derivations/sliding_window_filter.md.
///
/// Not applicable with the textbook linearisation, which adds information in G, or with landmarks of known position.
class Datum {
 public:
  /// Starts with the prior of the first pose only. Inactive if its information is singular: the gauge is then unknown.
  void start(const Prior& prior);
  /// Starts with the prior of the first pose; `carried` is additional covariance of that pose, kept outside the window.
  void start(const Prior& prior, const urban_nav_core::Matrix6d& carried);
  void disable() { active_ = false; }
  bool isActive() const { return active_; }

  /// Sets the point about which (shift, turn) are expressed; before each marginalisation, near the window.
  void moveTo(const Eigen::Vector3d& origin);
  const Eigen::Vector3d& origin() const { return origin_; }

  /// Updates M after the oldest pose was marginalised, with `loss` of M (Departed::gauge_loss).
  void marginalised(const urban_nav_core::Matrix6d& loss);
  /// Scales the growth of the last step by ratios of variances (drift_sandwich.hpp). The difference is carried
  /// separately; the window is unchanged.
  void scaleGrowth(const DriftSandwich::Ratio& ratio);
  /// Covariance that the last step added to gamma, about origin().
  const urban_nav_core::Matrix6d& growth() const { return growth_; }

  /// Moves the coupling between the disparity offset and the window's position from the prior to this object. An error
  /// of the offset is a scale error proportional to the distance driven, and the same in every step: a change of its
  /// estimate therefore affects future steps, and `odom` has no discontinuities. Returns d(gamma)/d(offset) of the last
  /// step, 1/px.
  urban_nav_core::Vector6d releaseOffset(const State& state, Prior& prior);
  /// Result of the last releaseOffset(), about origin(), with the offset of that step; empty if nothing was released.
  struct Release {
    urban_nav_core::Vector6d per_px = urban_nav_core::Vector6d::Zero();
    double used = 0.0;
  };
  const std::optional<Release>& release() const { return release_; }
  /// Sets the current estimate of the offset, which applies to earlier steps as well.
  void setOffset(const DisparityOffsetEstimate& offset) { offset_ = offset; }
  /// Returns the relative standard deviation of all lengths of the path due to the offset's current error and the rig
  /// scale.
  double scaleSigma() const;
  /// Sets the relative standard deviation of all lengths besides that of the offset.
  void setRigScale(double sigma) { rig_scale_ = sigma; }

  /// Replaces M by a stronger one once M^-1 exceeds `ratio` times the inverse of `local`, the information of one frame
  /// on its own pose. Returns whether it was replaced: the covariance inside the window has then decreased by G_b
  /// shift() G_b^T.
  bool fixGauge(const urban_nav_core::Matrix6d& local, double ratio, const State& state, Prior& prior);
  const urban_nav_core::Matrix6d& shift() const { return shift_; }

  /// Returns the covariance of this pose that is not contained in the window.
  urban_nav_core::Matrix6d carried(const urban_nav_core::Pose& T_odom_camera) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  void computeGaugeProducts(const State& state, const Prior& prior);

  bool active_ = false;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  urban_nav_core::Matrix6d information_ = urban_nav_core::Matrix6d::Zero();  // M
  urban_nav_core::Matrix6d carried_ = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Matrix6d growth_ = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Matrix6d shift_ = urban_nav_core::Matrix6d::Zero();
  std::vector<double> directions_, held_, deviation_, gradient_, product_;  // n x 6, column-major: G, u = Pi G; n
  // Sums of the steps' contributions to gamma per pixel of offset, and for the offsets used by the steps.
  urban_nav_core::Vector6d along_px_ = urban_nav_core::Vector6d::Zero();
  urban_nav_core::Vector6d along_used_ = urban_nav_core::Vector6d::Zero();
  std::optional<Release> release_;
  DisparityOffsetEstimate offset_;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();  // origin of the path
  Eigen::Vector3d step_ = Eigen::Vector3d::Zero();   // last displacement of origin(), m
  double rig_scale_ = 0.0;
  double shifted_per_px_ = 0.0, squared_steps_ = 0.0;  // sums over steps: shift per pixel along the step; m^2
  double strength_m_ = 0.0, strength_rad_ = 0.0;       // largest values of `local`
};

}  // namespace swf_vo
