// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "pose_graph/reference_solver.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {

/// The relaxation of Newman et al. 2009, section 5 (eq. 8-19): the state is the chain of transforms v_r from pose r - 1
/// to pose r, and conjugate gradients solve for its increments without H ever being stored. It minimises the geodesic
/// cost of problem.hpp and is the reference that the default solver is held against; it is not the fast way.
///
/// What the print leaves open, and what is done here:
/// - (9) has no weights; here every edge has its information, which may be singular but for the chain's.
/// - The blocks of (16) are those with m < k <= q; a closure may also run backwards (m > q).
/// - (19) is solved for increments, so that its lower right-hand side is vo - v, not vo.
/// - Jacobians are those of the residuals where they are, not of small ones.
struct RelativePcgOptions {
  int iterations = 100;     ///< steps at most, refused ones included
  double tolerance = 1e-9;  ///< ends where a step promises less than this share of the cost
  int products = 2000;      ///< with H in one step, at most
  /// Closures whose coupling the preconditioner knows exactly (a dense matrix of this many blocks is factorised at each
  /// step). 300 in space: 0.4 s a step and 26 MB. With all closures among them a step takes one or two products.
  int coupled_closures = 300;
  /// Called after each accepted step; return false to end there. May be empty.
  std::function<bool(int iteration, double cost)> progress;
};

/// As the default solver's; the cost never rises from one of its iterations to the next. cost_start is cost_before.
template <int D>
struct RelativeSolution : Solution<D> {
  int products = 0;  ///< with H, over all steps: the iterations of conjugate gradients
};

/// Relaxes from problem.poses; pose 0 stays. Throws UserError, naming the edge or the pose, for: a number that is not
/// finite, an edge to a pose that does not exist or to itself, information that is indefinite, and where the edges
/// between two consecutive poses together are missing or have no information in some direction. The same input gives
/// the same bits.
template <int D>
RelativeSolution<D> relaxRelative(const Problem<D>& problem, const RelativePcgOptions& options = {});

/// relaxRelative() as pose_graph.solver = relative_pcg selects it: from problem.poses, whatever SolveOptions::start;
/// geodesic only.
ReferenceSolver relativeSolver();

extern template RelativeSolution<2> relaxRelative(const Problem<2>&, const RelativePcgOptions&);
extern template RelativeSolution<3> relaxRelative(const Problem<3>&, const RelativePcgOptions&);

}  // namespace pose_graph
