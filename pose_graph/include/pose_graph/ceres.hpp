// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/solution.hpp"

namespace pose_graph {

/// solve() by Ceres (Agarwal, Mierle and others; SPARSE_NORMAL_CHOLESKY on SuiteSparse, one thread, its other settings
/// as they are): another program's word on the same residuals, with our derivatives of them. Slower; every objective
/// and start. Poses are increments (turn, shift) to where it begins, so that no pose may turn by a full round on its
/// way.
template <int D>
Solution<D> solveByCeres(const Problem<D>& problem, const SolveOptions& options,
                         const std::vector<double>& weights = {});

extern template Solution<2> solveByCeres(const Problem<2>&, const SolveOptions&, const std::vector<double>&);
extern template Solution<3> solveByCeres(const Problem<3>&, const SolveOptions&, const std::vector<double>&);

}  // namespace pose_graph
