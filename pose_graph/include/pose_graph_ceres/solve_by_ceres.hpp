// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/reference_solver.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {

/// solve() by Ceres (Agarwal, Mierle and others; SPARSE_NORMAL_CHOLESKY on SuiteSparse, one thread, other options at
/// their defaults): an independent minimiser of the same residuals, with the Jacobians of this package. Slower.
/// Supports all objectives and starts. Poses are parametrised as increments (rotation vector, translation) to the
/// initial guess, hence no pose may rotate by a full turn during minimisation.
template <int D>
Solution<D> solveByCeres(const Problem<D>& problem, const SolveOptions& options,
                         const std::vector<double>& weights = {});

/// Returns solveByCeres() as selected by pose_graph.solver = ceres.
ReferenceSolver ceresSolver();

extern template Solution<2> solveByCeres(const Problem<2>&, const SolveOptions&, const std::vector<double>&);
extern template Solution<3> solveByCeres(const Problem<3>&, const SolveOptions&, const std::vector<double>&);

}  // namespace pose_graph
