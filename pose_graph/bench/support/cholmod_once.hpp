// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/problem.hpp"

namespace pose_graph::bench {

/// Returns the processor time (s) of CHOLMOD with default settings to order, analyse and factorise the Gauss-Newton
/// matrix of a problem once (pose 0 held), the median of `runs`: a reference for sparse solvers. Negative if the matrix
/// is not positive definite.
template <int D>
double cholmodOnce(const Problem<D>& problem, int runs);

}  // namespace pose_graph::bench
