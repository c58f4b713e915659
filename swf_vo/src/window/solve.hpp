// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/cost.hpp"
#include "window/dense_cholesky.hpp"
#include "window/pose_elimination.hpp"
#include "window/prior.hpp"

namespace swf_vo {

/// Solves Lambda d = g of eq. 3 (Newman et al. 2009, section 2.1) and keeps the factor for further right-hand sides and
/// for covariances. An archived state contains the factor, not the steps.
///
/// Map-onto-path: landmarks outside the prior are block-diagonal and are eliminated first, 3x3 by 3x3, onto the path;
/// then the landmarks of the prior, then the poses, oldest first, in one dense Cholesky factorisation. Path-onto-map
/// (pose_elimination.hpp) where that is cheaper.
class Solver {
 public:
  enum class Elimination { Cheaper, LandmarksFirst, PosesFirst };
  explicit Solver(Elimination elimination = Elimination::Cheaper) : elimination_(elimination) {}

  /// Returns whether the last factorisation eliminated poses first.
  bool eliminatedPosesFirst() const { return poses_first_; }

  /// Factors the matrices of `equations` and the prior. With `datum` the oldest pose is held, for systems without
  /// absolute information; this is exact, since a gradient without component in the gauge directions has a solution
  /// that leaves that pose unchanged.
  void factor(const State& state, const Prior& prior, const NormalEquations& equations, bool datum);
  /// Computes the step for the gradients of `equations` and of the prior, with the last factor.
  void solve(const State& state, const Prior& prior, const NormalEquations& equations,
             const std::vector<double>& prior_gradient, double prior_offset_gradient);

  /// Step of the last solve: of pose j, of the landmark in a slot, of the disparity offset.
  urban_nav_core::Vector6d poseStep(std::size_t j) const;
  const Eigen::Vector3d& landmarkStep(std::size_t slot) const { return landmark_step_[slot]; }
  double offsetStep() const { return offset_step_; }
  /// d^T g: twice the predicted decrease of the quadratic.
  double decrement() const { return decrement_; }

  /// Column (pose j, component c) of the inverse, the covariance conditional on the disparity offset: landmarks of the
  /// prior, then poses. With `poses_only` the rows of landmarks are not computed. Valid until the next call.
  const std::vector<double>& inverseColumn(std::size_t j, int c, bool poses_only) const;
  /// All six columns of pose j, complete and consecutive. Valid until the next call.
  const std::vector<double>& inverseColumns(std::size_t j) const;
  /// First row of pose j in such a column.
  std::size_t toRow(std::size_t j) const { return offset_ + 6 * j; }
  /// Variance of the disparity offset (px^2); 0 if it is a constant. perOffset: derivative of the estimate in a row by
  /// the offset.
  double offsetVariance() const { return border_.used ? 1.0 / border_.pivot : 0.0; }
  /// Information of the measurements on the offset with all other states marginalised, and gradient of the calibration
  /// at an estimate (terms of Prior).
  double offsetInformation() const;
  double offsetPull(const Prior& prior, double offset) const;
  /// Factor by which that information is reduced (in variance).
  double offsetCaution() const { return border_.caution; }
  double perOffset(std::size_t row) const { return border_.used ? -border_.rows[row] : 0.0; }
  std::size_t poses() const { return poses_; }
  /// Number of rows of such a column.
  std::size_t rows() const { return offset_ + 6 * poses_; }
  void archive(urban_nav_core::Archive& archive);

 private:
  bool isCheaperPosesFirst(const State& state, const Prior& prior) const;
  void factorLandmarksFirst(const State& state, const Prior& prior, const NormalEquations& equations, bool datum);
  /// A right-hand side; the border is solved for as one, too. `prior`: landmarks of the prior, then the oldest pose;
  /// may be empty.
  struct RightSide {
    const std::vector<double>& prior;
    const std::vector<urban_nav_core::Vector6d>& pose;
    const std::vector<Eigen::Vector3d>& landmark;
  };
  void solveFor(const State& state, const Prior& prior, const NormalEquations& equations, const RightSide& right);
  void solveLandmarksFirst(const State& state, const Prior& prior, const NormalEquations& equations,
                           const RightSide& right);
  void solvePosesFirst(const State& state, const Prior& prior, const RightSide& right);
  void factorBorder(const State& state, const Prior& prior, const NormalEquations& equations);
  double dotBorder(const State& state, const Prior& prior, const NormalEquations& equations) const;
  struct Strip {
    int columns = 0, first = 1 << 30, last = 0;  // rows affected
  };
  void eliminateFree(const State& state, const NormalEquations& equations);
  void subtractStrip(Strip& strip);

  DenseMatrix dense_, onto_poses_;
  StripProduct product_;
  std::vector<double> columns_;
  DenseCholesky cholesky_;
  std::vector<Eigen::Matrix3d> inverse_root_;  // R with R^T R = Lambda_m(i, i)^-1, lower triangular, by slot
  std::vector<Matrix63d> eliminated_;          // cross R^T, indexed as NormalEquations::cross
  Elimination elimination_;
  bool poses_first_ = false;
  PoseElimination pose_elimination_;
  std::vector<double> floor_, rhs_;
  mutable std::vector<double> path_, map_;
  std::vector<double> right_path_, right_map_;
  mutable std::vector<double> column_, columns_of_pose_;
  std::vector<Eigen::Vector3d> landmark_step_;
  std::size_t poses_ = 0;
  std::size_t offset_ = 0;  // first row of the poses
  double decrement_ = 0.0;
  double offset_step_ = 0.0;
  struct {
    bool used = false;
    std::vector<double> rows;               // Lambda^-1 border: landmarks of the prior, then poses
    std::vector<Eigen::Vector3d> landmark;  // ... by slot
    double pivot = 1.0;                     // remaining information of the offset
    double calibration = 0.0;               // calibration's part of it
    double caution = 1.0;                   // divisor of the measured information
  } border_;
};

}  // namespace swf_vo
