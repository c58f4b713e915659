// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "pose_graph/reference_solver.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {

/// The relaxation of Newman et al. 2009, section 5 (eq. 8-19). The state is the chain of transforms v_r from pose r - 1
/// to pose r; conjugate gradients solve for its increments without forming H. Minimises the geodesic cost of
/// problem.hpp. Serves as a reference for tests of the default solver, which is faster.
///
/// Details not specified by the paper:
/// - (9) is unweighted; here each edge has its information, which may be singular except in the chain.
/// - The blocks of (16) are those with m < k <= q; closures with m > q are supported too.
/// - (19) is solved for increments, so its lower right-hand side is vo - v, not vo.
/// - Jacobians are exact at any residual; the paper assumes small ones.
struct RelativePcgOptions {
  int iterations = 100;     ///< limit, including rejected steps
  double tolerance = 1e-9;  ///< converged if the predicted decrease is below this share of the cost
  int products = 2000;      ///< limit of products with H per step
  /// Number of closures whose coupling the preconditioner includes exactly; a dense matrix of as many blocks is
  /// factorised in each step. 300 in space: 0.4 s per step and 26 MB. If all closures are included, a step takes one or
  /// two products.
  int coupled_closures = 300;
  /// Called after each accepted step; return false to stop. May be empty.
  std::function<bool(int iteration, double cost)> progress;
};

/// As the default solver's solution; the cost decreases monotonically. cost_start equals cost_before.
template <int D>
struct RelativeSolution : Solution<D> {
  int products = 0;  ///< products with H over all steps: conjugate-gradient iterations
};

/// Relaxes from problem.poses; pose 0 is held. The same input gives bit-identical results.
/// Throws UserError, naming the edge or the pose, if a number is not finite, an edge refers to a missing pose or joins
/// a pose to itself, an information is indefinite, or the edges between two consecutive poses are missing or leave a
/// direction without information.
template <int D>
RelativeSolution<D> relaxRelative(const Problem<D>& problem, const RelativePcgOptions& options = {});

/// Returns relaxRelative() as selected by pose_graph.solver = relative_pcg. It starts from problem.poses, ignores
/// SolveOptions::start and supports the geodesic objective only.
ReferenceSolver relativeSolver();

extern template RelativeSolution<2> relaxRelative(const Problem<2>&, const RelativePcgOptions&);
extern template RelativeSolution<3> relaxRelative(const Problem<3>&, const RelativePcgOptions&);

}  // namespace pose_graph
