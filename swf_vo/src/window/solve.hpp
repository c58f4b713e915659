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
/// for covariances. A state has the factor, not the steps.
///
/// Map-onto-path: landmarks that the prior does not touch are block-diagonal and are eliminated first, 3x3 by 3x3, onto
/// the path; then the landmarks of the prior, then the poses, oldest first, in one dense Cholesky. Path-onto-map
/// (pose_elimination.hpp) where that is less work.
class Solver {
 public:
  enum class Elimination { Cheaper, LandmarksFirst, PosesFirst };
  explicit Solver(Elimination elimination = Elimination::Cheaper) : elimination_(elimination) {}

  /// Returns whether the last factorisation eliminated poses first.
  bool eliminatedPosesFirst() const { return poses_first_; }

  /// Factors the matrices of `equations` and the prior's. With `datum` the oldest pose is held: the way to solve where
  /// no absolute information is, and exact there, for a gradient without share in the gauge directions can be answered
  /// without moving it.
  void factor(const State& state, const Prior& prior, const NormalEquations& equations, bool datum);
  /// The step for the gradients of `equations` and the prior's gradient, with the last factor.
  void solve(const State& state, const Prior& prior, const NormalEquations& equations,
             const std::vector<double>& prior_gradient, double prior_offset_gradient);

  /// Steps of the last solve: of pose j, of the landmark in a slot, of the disparity offset.
  urban_nav_core::Vector6d poseStep(std::size_t j) const;
  const Eigen::Vector3d& landmarkStep(std::size_t slot) const { return landmark_step_[slot]; }
  double offsetStep() const { return offset_step_; }
  /// d^T g: twice the decrease that the quadratic promises.
  double decrement() const { return decrement_; }

  /// Column (pose j, component c) of the inverse, the covariance were the disparity offset known: landmarks of the
  /// prior, then poses. With `poses_only` the rows of the landmarks are not made. Valid until the next call.
  const std::vector<double>& inverseColumn(std::size_t j, int c, bool poses_only) const;
  /// All six columns of pose j, whole and one after the other. Valid until the next call.
  const std::vector<double>& inverseColumns(std::size_t j) const;
  /// Row where pose j begins in such a column.
  std::size_t toRow(std::size_t j) const { return offset_ + 6 * j; }
  /// Variance of the disparity offset (px^2), 0 where it is a constant, and how the estimate in such a row goes with
  /// it.
  double offsetVariance() const { return border_.used ? 1.0 / border_.pivot : 0.0; }
  /// What measurements say of the offset with all else marginalised, and what the calibration pulls at an estimate:
  /// Prior's terms of it.
  double offsetInformation() const;
  double offsetPull(const Prior& prior, double offset) const;
  /// By how much less that information is believed than it says (in variance).
  double offsetCaution() const { return border_.caution; }
  double perOffset(std::size_t row) const { return border_.used ? -border_.rows[row] : 0.0; }
  std::size_t poses() const { return poses_; }
  /// Of such a column.
  std::size_t rows() const { return offset_ + 6 * poses_; }
  void archive(urban_nav_core::Archive& archive);

 private:
  bool isCheaperPosesFirst(const State& state, const Prior& prior) const;
  void factorLandmarksFirst(const State& state, const Prior& prior, const NormalEquations& equations, bool datum);
  /// A right-hand side, or the border, which is solved for as one. `prior`: landmarks of the prior, then the oldest
  /// pose; may be empty.
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
    int columns = 0, first = 1 << 30, last = 0;  // rows touched
  };
  void eliminateFree(const State& state, const NormalEquations& equations);
  void subtractStrip(Strip& strip);

  DenseMatrix dense_, onto_poses_;
  StripProduct product_;
  std::vector<double> columns_;
  DenseCholesky cholesky_;
  std::vector<Eigen::Matrix3d> inverse_root_;  // by slot: R with R^T R = Lambda_m(i, i)^-1, lower triangular
  std::vector<Matrix63d> eliminated_;          // cross R^T, as NormalEquations::cross
  Elimination elimination_;
  bool poses_first_ = false;
  PoseElimination pose_elimination_;
  std::vector<double> floor_, rhs_;
  mutable std::vector<double> path_, map_;
  std::vector<double> right_path_, right_map_;
  mutable std::vector<double> column_, columns_of_pose_;
  std::vector<Eigen::Vector3d> landmark_step_;
  std::size_t poses_ = 0;
  std::size_t offset_ = 0;  // where the poses begin
  double decrement_ = 0.0;
  double offset_step_ = 0.0;
  struct {
    bool used = false;
    std::vector<double> rows;               // Lambda^-1 border: landmarks of the prior, then poses
    std::vector<Eigen::Vector3d> landmark;  // ... by slot
    double pivot = 1.0;                     // what is left of the offset's information
    double calibration = 0.0;               // ... that of the calibration
    double caution = 1.0;                   // what the measurements' is divided by
  } border_;
};

}  // namespace swf_vo
