// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linear_system.hpp"

namespace pose_graph {

/// Approximates the inverse of (1 + damping) M + H^T W H: the chain exactly, and of the closures up to `coupled` of
/// them, by Woodbury's identity
///
///     (N + G^T G)^-1 = N^-1 - N^-1 G^T (I + G N^-1 G^T)^-1 G N^-1
///
/// in which no information is inverted, so that it may be singular. G N^-1 G^T is the covariance that odometry alone
/// gives two closures in common: a difference of prefix sums over the part of the chain that both span. Where there are
/// more closures, the ones about which odometry says least against their own information are coupled, and conjugate
/// gradients have the rest to do.
template <int D>
class Preconditioner {
 public:
  /// Keeps a reference to `system`, which must outlive it.
  Preconditioner(const LinearSystem<D>& system, double damping, int coupled);

  /// result = P step, P symmetric and positive definite. `scratch`: overwritten.
  void apply(const Increments<D>& step, Increments<D>& result, Increments<D>& scratch) const;

 private:
  void choose(std::size_t coupled);
  void factorise();

  const LinearSystem<D>& system_;
  std::vector<TangentMatrix<D>> inverses_;  // of the chain's blocks
  std::vector<TangentMatrix<D>> spread_;    // covariance of x_k by odometry alone
  std::vector<std::size_t> chosen_;         // closures, into system_.rows()
  Eigen::MatrixXd factor_;                  // of I + G N^-1 G^T, lower triangle
};

}  // namespace pose_graph
