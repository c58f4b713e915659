// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/problem.hpp"

namespace pose_graph::bench {

/// Seconds of the processor that CHOLMOD with its default settings takes to order, analyse and factorise the
/// Gauss-Newton matrix of a problem (pose 0 held) once, the median of `runs`: what every sparse solver is held against.
/// Negative where it finds the matrix not positive definite.
template <int D>
double cholmodOnce(const Problem<D>& problem, int runs);

}  // namespace pose_graph::bench
