// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "preconditioner.hpp"

namespace pose_graph {

template <int D>
struct PcgResult {
  Increments<D> step;
  double promise = 0.0;  ///< by how much half the cost falls to second order, were the system undamped
  int iterations = 0;
};

/// Preconditioned conjugate gradients (Hestenes and Stiefel 1952) on ((1 + damping) M + H^T W H) step = b from zero,
/// until the residual, measured by the preconditioner, is `tolerance` of what it was, or max_iterations.
template <int D>
PcgResult<D> conjugateGradients(const LinearSystem<D>& system, const Preconditioner<D>& preconditioner, double damping,
                                double tolerance, int max_iterations);

}  // namespace pose_graph
