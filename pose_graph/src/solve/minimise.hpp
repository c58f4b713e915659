// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/solution.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

/// Result of a minimisation.
struct Descent {
  double cost = 0.0;
  std::vector<Iteration> iterations;
  Ending ending = Ending::Converged;
};

/// Gauss-Newton; Levenberg-Marquardt if a plain step would raise the cost (Nocedal, Wright, Numerical Optimization,
/// chapter 10; damping proportional to the diagonal, as in Marquardt's method). Only an undamped step can indicate
/// convergence, since a strongly damped step predicts little decrease anywhere. Updates `poses` in place; their cost
/// never increases.
template <int D>
Descent minimise(NormalEquations<D>& equations, BlockCholesky<kTangentSize<D>>& cholesky, const SolveOptions& options,
                 const std::vector<double>& weights, std::vector<Rigid<D>>& poses);

extern template Descent minimise<2>(NormalEquations<2>&, BlockCholesky<3>&, const SolveOptions&,
                                    const std::vector<double>&, std::vector<Rigid<2>>&);
extern template Descent minimise<3>(NormalEquations<3>&, BlockCholesky<6>&, const SolveOptions&,
                                    const std::vector<double>&, std::vector<Rigid<3>>&);

}  // namespace pose_graph
