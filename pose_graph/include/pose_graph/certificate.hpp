// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Bound on the distance of a solution from the global minimum of the chordal objective.
struct Certificate {
  bool certified = false;     ///< no poses have a cost lower by more than 1e-4 of `cost`
  double cost = 0.0;          ///< chordal cost of the given poses
  std::optional<double> gap;  ///< the global minimum is at least cost - gap; empty: no bound found
};

/// Tests whether a minimum of the chordal objective is the global one (Rosen, Carlone, Bandeira, Leonard, SE-Sync, IJRR
/// 2019, section 4; the translations are kept so that all matrices stay sparse).
///
/// The cost is tr(X M X^T) with X = [t_1 R_1 t_2 R_2 ...]. Let S = M - diag(0, Lambda_i) with any symmetric Lambda_i.
/// If no eigenvalue of S on the rotations is below -eta, the global minimum is at least sum tr(Lambda_i) - eta * D * n.
/// This holds for every Lambda, hence the bound does not depend on how well the minimisation has converged. Lambda_i =
/// sym(R_i^T (X M)_i) is the multiplier of R_i^T R_i = I at a minimum. A Cholesky factorisation tests whether S + eta
/// is positive semidefinite, to its round-off. In a component with fixed poses, X contains constants; the bound is then
/// the minimum of tr(X S X^T) over all other blocks, which takes one more linear solve.
///
/// Cost: one or a few factorisations with blocks of D + 1. The global minimum may remain uncertified if the noise is
/// large.
/// Requires: a well-formed problem (problem.hpp). `weights` as in cost().
template <int D>
Certificate certify(const Problem<D>& problem, const std::vector<Rigid<D>>& poses,
                    const std::vector<double>& weights = {});

/// Minimises the chordal objective further, from `poses` until round-off prevents progress, and certifies the result.
/// At the global minimum the bound is tight to about 1e-8 of the cost; away from a minimum S has negative eigenvalues.
/// Replaces `poses` unless their cost is lower than that of the result. Takes a few factorisations more than certify().
template <int D>
Certificate certifyConverged(const Problem<D>& problem, std::vector<Rigid<D>>& poses,
                             const std::vector<double>& weights = {});

extern template Certificate certify(const Problem<2>&, const std::vector<Rigid<2>>&, const std::vector<double>&);
extern template Certificate certify(const Problem<3>&, const std::vector<Rigid<3>>&, const std::vector<double>&);
extern template Certificate certifyConverged(const Problem<2>&, std::vector<Rigid<2>>&, const std::vector<double>&);
extern template Certificate certifyConverged(const Problem<3>&, std::vector<Rigid<3>>&, const std::vector<double>&);

}  // namespace pose_graph
