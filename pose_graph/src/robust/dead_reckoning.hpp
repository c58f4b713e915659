// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

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

}  // namespace pose_graph
