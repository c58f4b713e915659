// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linear_system.hpp"

namespace pose_graph {

/// Approximates the inverse of (1 + damping) M + H^T W H. The chain is inverted exactly, and up to `coupled` closures
/// are included by Woodbury's identity
///
///     (N + G^T G)^-1 = N^-1 - N^-1 G^T (I + G N^-1 G^T)^-1 G N^-1
///
/// in which no information is inverted, so that it may be singular. G N^-1 G^T is the covariance of two closures due to
/// odometry, a difference of prefix sums over the section of the chain that both span. If there are more closures,
/// those whose information is largest relative to that of odometry are included; conjugate gradients handle the others.
template <int D>
class Preconditioner {
 public:
  /// Keeps a reference to `system`, which must outlive it.
  Preconditioner(const LinearSystem<D>& system, double damping, int coupled);

  /// Computes result = P step; P is symmetric and positive definite. `scratch`: overwritten.
  void apply(const Increments<D>& step, Increments<D>& result, Increments<D>& scratch) const;

 private:
  void choose(std::size_t coupled);
  void factorise();

  const LinearSystem<D>& system_;
  std::vector<TangentMatrix<D>> inverses_;  // inverses of the chain's blocks
  std::vector<TangentMatrix<D>> spread_;    // covariance of x_k due to odometry only
  std::vector<std::size_t> chosen_;         // indices of closures in system_.rows()
  Eigen::MatrixXd factor_;                  // factor of I + G N^-1 G^T, lower triangle
};

}  // namespace pose_graph
