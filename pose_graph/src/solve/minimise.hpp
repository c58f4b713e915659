// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/solution.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

/// What a minimisation did.
struct Descent {
  double cost = 0.0;
  std::vector<Iteration> iterations;
  Ending ending = Ending::Converged;
};

/// Gauss-Newton, and Levenberg-Marquardt where a plain step would raise the cost (Nocedal, Wright, Numerical
/// Optimization, chapter 10; damping in proportion to the diagonal as Marquardt has it). Only an undamped step ends it
/// as converged: one that is damped until it is short promises little anywhere. `poses` are moved in place; they are
/// never worse than they were.
template <int D>
Descent minimise(NormalEquations<D>& equations, BlockCholesky<kTangentSize<D>>& cholesky, const SolveOptions& options,
                 const std::vector<double>& weights, std::vector<Rigid<D>>& poses);

extern template Descent minimise<2>(NormalEquations<2>&, BlockCholesky<3>&, const SolveOptions&,
                                    const std::vector<double>&, std::vector<Rigid<2>>&);
extern template Descent minimise<3>(NormalEquations<3>&, BlockCholesky<6>&, const SolveOptions&,
                                    const std::vector<double>&, std::vector<Rigid<3>>&);

}  // namespace pose_graph
