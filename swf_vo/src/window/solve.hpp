// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/cost.hpp"
#include "window/dense_cholesky.hpp"
#include "window/prior.hpp"

namespace swf_vo {

/// Solves Lambda d = g of eq. 3 (Newman et al. 2009, section 2.1) and keeps the factor for further right-hand sides and for
/// covariances.
///
/// Landmarks that the prior does not touch are block-diagonal: they are eliminated first, 3x3 by 3x3, onto the path
/// (map-onto-path); then the landmarks of the prior, then the poses, oldest first, in one dense Cholesky.
class Solver {
 public:
  /// Factors the matrices of `equations` and the prior's. With `datum` the oldest pose is held: the way to solve where no absolute
  /// information is, and exact there, for a gradient without share in the gauge directions can be answered without moving it.
  void factor(const State& state, const Prior& prior, const NormalEquations& equations, bool datum);
  /// The step for the gradients of `equations` and the prior's gradient, with the last factor.
  void solve(const State& state, const Prior& prior, const NormalEquations& equations, const std::vector<double>& prior_gradient);

  /// Steps of the last solve: of pose j, of the landmark in a slot.
  urban_nav_core::Vector6d poseStep(std::size_t j) const;
  const Eigen::Vector3d& landmarkStep(std::size_t slot) const { return landmark_step_[slot]; }
  /// d^T g: twice the decrease that the quadratic promises.
  double decrement() const { return decrement_; }

  /// Column (pose j, component c) of the inverse, the covariance: landmarks of the prior, then poses. With `poses_only` the
  /// rows of the landmarks are not made. Valid until the next call.
  const std::vector<double>& inverseColumn(std::size_t j, int c, bool poses_only) const;
  /// Row where pose j begins in such a column.
  std::size_t rowOf(std::size_t j) const { return offset_ + 6 * j; }
  std::size_t poses() const { return poses_; }

 private:
  void eliminateFree(const State& state, const NormalEquations& equations);

  DenseMatrix dense_;
  DenseCholesky cholesky_;
  std::vector<Eigen::Matrix3d> inverse_root_;  // by slot: R with R^T R = Lambda_m(i, i)^-1, lower triangular
  std::vector<Matrix63d> eliminated_;          // cross R^T, as NormalEquations::cross
  std::vector<double> floor_, rhs_;
  mutable std::vector<double> column_;
  std::vector<Eigen::Vector3d> landmark_step_;
  std::size_t poses_ = 0;
  std::size_t offset_ = 0;  // where the poses begin
  double decrement_ = 0.0;
};

}  // namespace swf_vo
