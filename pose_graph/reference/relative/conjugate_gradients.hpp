// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "preconditioner.hpp"

namespace pose_graph {

template <int D>
struct PcgResult {
  Increments<D> step;
  double promise = 0.0;  ///< decrease of half the cost to second order, for the undamped system
  int iterations = 0;
};

/// Solves ((1 + damping) M + H^T W H) step = b by preconditioned conjugate gradients (Hestenes and Stiefel 1952) from
/// zero, until the residual in the preconditioner's norm has decreased by `tolerance`, or for max_iterations.
template <int D>
PcgResult<D> conjugateGradients(const LinearSystem<D>& system, const Preconditioner<D>& preconditioner, double damping,
                                double tolerance, int max_iterations);

}  // namespace pose_graph
