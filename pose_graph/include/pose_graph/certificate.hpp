// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// What is known of how far poses are from the best there are, by the chordal objective.
struct Certificate {
  bool certified = false;     ///< no poses cost less by more than a ten-thousandth of their cost
  double cost = 0.0;          ///< of these poses
  std::optional<double> gap;  ///< no poses cost less than cost - gap; empty: nothing is known
};

/// Is a minimum of the chordal objective the global one? (Rosen, Carlone, Bandeira, Leonard, SE-Sync, IJRR 2019,
/// section 4, with the translations left in, so that everything stays sparse.)
///
/// The cost is tr(X M X^T), X = [t_1 R_1 t_2 R_2 ...], and for every symmetric Lambda_i with S = M - diag(0, Lambda_i)
/// that is nowhere less than -eta on the rotations, no poses cost less than sum tr(Lambda_i) - eta * D * n: whatever
/// Lambda is, so that the bound does not rest on how well the minimisation has converged. Lambda_i = sym(R_i^T (X M)_i)
/// is the multiplier of R_i^T R_i = I at a minimum. That S + eta is positive semidefinite is what a Cholesky
/// factorisation finds, to its round-off. Of a part with fixed poses X holds constants, and the bound is the least
/// value of tr(X S X^T) over all others, by one more solution.
///
/// One or a few factorisations of blocks of D + 1. A minimum that is not certified may still be the global one where
/// noise is large. `weights` as in cost(); the problem must be sound.
template <int D>
Certificate certify(const Problem<D>& problem, const std::vector<Rigid<D>>& poses,
                    const std::vector<double>& weights = {});

/// Minimises the chordal objective further, from `poses` until round-off decides, and certifies the result. The bound
/// is some 1e-8 of the cost where that is the global minimum: as far as poses are from a minimum, S has negative
/// eigenvalues. `poses` are replaced unless they cost less than the result. Some factorisations more than certify().
template <int D>
Certificate certifyConverged(const Problem<D>& problem, std::vector<Rigid<D>>& poses,
                             const std::vector<double>& weights = {});

extern template Certificate certify(const Problem<2>&, const std::vector<Rigid<2>>&, const std::vector<double>&);
extern template Certificate certify(const Problem<3>&, const std::vector<Rigid<3>>&, const std::vector<double>&);
extern template Certificate certifyConverged(const Problem<2>&, std::vector<Rigid<2>>&, const std::vector<double>&);
extern template Certificate certifyConverged(const Problem<3>&, std::vector<Rigid<3>>&, const std::vector<double>&);

}  // namespace pose_graph
