// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/io/archive.hpp"
#include "window/drift_sandwich.hpp"
#include "window/prior.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// What is known of the disparity offset, px.
struct OffsetBelief {
  double used = 0.0;                  ///< the estimate that poses rest on
  double mean = 0.0, variance = 0.0;  ///< of the true one
  /// Mean square of the error of the estimate.
  double error() const { return variance + (mean - used) * (mean - used); }
};

/// Where the window stands in `odom`, and how well that is known.
///
/// All measurements are relative, and with first estimates none of them says anything in the six directions G of the
/// gauge. So Pi G is what is left of the prior of the first pose, and nothing else:
///   Pi = Pi_relative + v M v^T,   Pi_relative G = 0,   M = G^T Pi G,   v = Pi G M^-1,
/// with M the information on gamma = v^T x, the place of the window as a whole (its shape given). Neither the estimate
/// nor the covariance of the shape depends on M; the covariance of a block is that of the shape plus G_b M^-1 G_b^T.
/// Hence
///
/// * M may be exchanged for a stronger W at any time, with M^-1 - W^-1 carried beside the window, and nothing has
/// changed: rounding no longer
///   eats what is known of the way back to the first pose, and Gauss-Newton has no loose direction to run along (hold);
/// * marginalising can only lower M, and what M^-1 grows by is the drift of this step: the part of the error that never
/// comes back
///   (growth). It is positive semidefinite, and the drift from one pose to another is the sum of the steps'.
///
/// Derivation: docs/derivations/sliding_window_filter.md.
///
/// Not for the textbook's linearisation, which puts information into G, nor where places of landmarks are known.
class Datum {
 public:
  /// The prior is that of the first pose alone. Where its information is singular, nothing is known of the gauge and
  /// isActive is false.
  void start(const Prior& prior);
  /// Likewise, with what is not known of that pose carried beside.
  void start(const Prior& prior, const urban_nav_core::Matrix6d& carried);
  void giveUp() { active_ = false; }
  bool isActive() const { return active_; }

  /// Point about which (shift, turn) are said; chosen anew before each marginalisation, near the window.
  void moveTo(const Eigen::Vector3d& origin);
  const Eigen::Vector3d& origin() const { return origin_; }

  /// The oldest pose has left, with `loss` of M (Marginaliser::gaugeLoss).
  void marginalised(const urban_nav_core::Matrix6d& loss);
  /// The variances of what the last step added are these times what the filter's model says (drift_sandwich.hpp): the
  /// difference is carried beside the window, which stays as it is.
  void scaleGrowth(const DriftSandwich::Ratio& ratio);
  /// Covariance that the last step added to gamma, about origin().
  const urban_nav_core::Matrix6d& growth() const { return growth_; }

  /// An error of the disparity offset is one of scale, and goes with the way travelled. What the prior ties between the
  /// offset and the place of the window is taken out of it and carried here, as the same error in every step: so what
  /// is learnt of the offset corrects the way to come, and `odom` never jumps. Returns d(gamma)/d(offset) of the last
  /// step, 1/px.
  urban_nav_core::Vector6d releaseOffset(const State& state, Prior& prior);
  /// Result of the last releaseOffset(), about origin(), with the offset of that step; empty if none was released.
  struct Release {
    urban_nav_core::Vector6d per_px = urban_nav_core::Vector6d::Zero();
    double used = 0.0;
  };
  const std::optional<Release>& release() const { return release_; }
  /// What is known of it by now, also of the offset that earlier steps were made with.
  void setOffset(const OffsetBelief& offset) { offset_ = offset; }
  /// By how much all lengths of the path are wrong for the error of the offset that is stated now (standard deviation).
  double scaleSigma() const;
  /// `sigma`: of a relative error of all lengths, beside that of the offset.
  void setRigScale(double sigma) { rig_scale_ = sigma; }

  /// `local`: information of one frame on its own pose. Holds the window at least so well once M^-1 exceeds `ratio`
  /// times its inverse; true if it did: what was covariance in the window before has then shrunk by G_b shift() G_b^T.
  bool hold(const urban_nav_core::Matrix6d& local, double ratio, const State& state, Prior& prior);
  const urban_nav_core::Matrix6d& shift() const { return shift_; }

  /// What the window's own covariance of this pose does not have.
  urban_nav_core::Matrix6d carried(const urban_nav_core::Pose& T_odom_camera) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  void look(const State& state, const Prior& prior);

  bool active_ = false;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  urban_nav_core::Matrix6d information_ = urban_nav_core::Matrix6d::Zero();  // M
  urban_nav_core::Matrix6d carried_ = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Matrix6d growth_ = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::Matrix6d shift_ = urban_nav_core::Matrix6d::Zero();
  std::vector<double> directions_, held_, deviation_, gradient_, product_;  // n x 6, column-major: G, u = Pi G; n
  // What steps so far added to gamma: for an offset that is off by a pixel, and with the offsets that they were made
  // with.
  urban_nav_core::Vector6d along_px_ = urban_nav_core::Vector6d::Zero();
  urban_nav_core::Vector6d along_used_ = urban_nav_core::Vector6d::Zero();
  std::optional<Release> release_;
  OffsetBelief offset_;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();  // where the path began
  Eigen::Vector3d step_ = Eigen::Vector3d::Zero();   // the last one of the origin, m
  double rig_scale_ = 0.0;
  double shifted_per_px_ = 0.0, squared_steps_ = 0.0;  // sums over steps: shift for a pixel along the step; m^2
  double strength_m_ = 0.0, strength_rad_ = 0.0;       // largest `local` so far
};

}  // namespace swf_vo
