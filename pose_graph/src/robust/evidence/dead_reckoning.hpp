// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "objective/whitened_edge.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Metres: the extent of a graph that does not move at all.
constexpr double kLeastExtent = 1e-3;
/// Poses: about the length of a visit to a place. Closures whose ends are as near are of one row, and one and the same
/// pair of places more or less; beyond, odometry's own error hides what a pair says.
constexpr int kRowReach = 10;

/// Dead reckoning along trusted edges between consecutive poses. Where there is none a new chain begins, in a frame of
/// its own.
template <int D>
struct DeadReckoning {
  std::vector<int> of_pose;         ///< which chain
  std::vector<Rigid<D>> pose;       ///< in its chain's frame
  std::vector<double> way;          ///< metres from its chain's first pose
  std::vector<TangentMatrix<D>> Q;  ///< covariance of the step from the pose before, in its chain's frame
  double extent = 0.0;              ///< twice the radius of gyration of the chains about their middles, metres

  DeadReckoning(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  /// Covariance of the pose of b in the frame of a, by composition; both on one chain. Costs |a - b|.
  TangentMatrix<D> covariance(int a, int b) const;
};

/// T moves a small motion (rho, phi) in the axes of its child to that of its parent.
template <int D>
TangentMatrix<D> adjoint(const Rigid<D>& T);

/// Inverse of an information, with directions that it does not measure as uncertain as can be: a heading lies within a
/// turn, a place within `extent` metres, evenly (variance of an even spread: its width squared over 12).
template <int D>
TangentMatrix<D> boundedCovariance(const TangentMatrix<D>& information, double extent);

/// Returns the fixed poses of a problem without those that lie where trusted edges lead from another one, to a
/// hundredth of the deviation that the last edge states. Such a pose was fixed where odometry had put it: that its
/// residuals are zero is no evidence of how large the errors of odometry are.
template <int D>
std::vector<int> withoutCopiedPoses(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

extern template std::vector<int> withoutCopiedPoses<2>(const Problem<2>&, const std::vector<EdgeRole>&);
extern template std::vector<int> withoutCopiedPoses<3>(const Problem<3>&, const std::vector<EdgeRole>&);

}  // namespace pose_graph
