// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "objective/whitened_edge.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Lower bound of the extent of a graph, m.
constexpr double kLeastExtent = 1e-3;
/// Reach of a row, in poses: about the length of a visit to a place. Closures whose ends are this near belong to one
/// row and measure almost the same pair of places; at larger distances the error of odometry dominates their
/// difference.
constexpr int kRowReach = 10;

/// Dead reckoning along trusted edges between consecutive poses. A missing edge starts a new chain with its own frame.
template <int D>
struct DeadReckoning {
  std::vector<int> of_pose;         ///< chain of each pose
  std::vector<Rigid<D>> pose;       ///< in the frame of its chain
  std::vector<double> way;          ///< path length from the first pose of its chain, m
  std::vector<TangentMatrix<D>> Q;  ///< covariance of the step from the previous pose, in the frame of its chain
  double extent = 0.0;              ///< twice the radius of gyration of the chains about their centroids, m

  DeadReckoning(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  /// Returns the composed covariance of the pose of b in the frame of a; both must be on one chain. Cost: linear in |a
  /// - b|.
  TangentMatrix<D> covariance(int a, int b) const;
};

/// Returns the adjoint of T, which maps a small motion (rho, phi) in the axes of its child to those of its parent.
template <int D>
TangentMatrix<D> adjoint(const Rigid<D>& T);

/// Returns the inverse of an information matrix with bounded uncertainty in unmeasured directions: headings are uniform
/// over a turn and positions uniform within `extent` m (variance of a uniform distribution: width squared over 12).
template <int D>
TangentMatrix<D> boundedCovariance(const TangentMatrix<D>& information, double extent);

/// Returns the fixed poses of a problem, without those that equal the prediction of trusted edges from another fixed
/// pose to a hundredth of the stated deviation of the last edge. Such a pose was fixed at its odometry pose: its zero
/// residuals are no evidence of the size of odometry errors.
template <int D>
std::vector<int> withoutCopiedPoses(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

extern template std::vector<int> withoutCopiedPoses<2>(const Problem<2>&, const std::vector<EdgeRole>&);
extern template std::vector<int> withoutCopiedPoses<3>(const Problem<3>&, const std::vector<EdgeRole>&);

}  // namespace pose_graph
