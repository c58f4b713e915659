// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/block_cholesky.hpp"
#include "objective/objective.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

/// The chordal objective as a quadratic form: its cost is tr(X M X^T) for X = [t_1 R_1 t_2 R_2 ...], M symmetric and
/// positive semidefinite by blocks of D + 1 (row and column 0 of a block are the translation, the others the rotation).
/// Rosen et al., SE-Sync, IJRR 2019, eq. 13, with the translations left in, so that everything stays sparse.
template <int D>
struct QuadraticForm {
  static constexpr int kB = D + 1;
  using Block = Eigen::Matrix<double, kB, kB>;

  /// Edges without weight are left out: what they alone connect are parts of their own.
  QuadraticForm(const Problem<D>& problem, const std::vector<double>& weights);
  QuadraticForm(const QuadraticForm&) = delete;
  QuadraticForm& operator=(const QuadraticForm&) = delete;

  /// Takes rows and columns out of A, which has M's pattern: those of fixed poses, and of each part without any the
  /// translation of its first pose, which may be shifted at no cost. What stands there instead is `pivot`.
  void hold(BlockMatrix<kB>& A, double pivot) const;
  bool holdsTranslation(int place) const { return held_[static_cast<std::size_t>(place)] != 0; }
  bool isFixed(int place) const { return fixed_[static_cast<std::size_t>(place)] != 0; }

  std::vector<EdgeTerm<D>> terms;  ///< of the edges that count, kappa and tau times their weights
  Unknowns unknowns;
  Adjacency graph;
  Symbolic symbolic;
  BlockPattern pattern;
  BlockMatrix<kB> M;

 private:
  explicit QuadraticForm(const Problem<D>& problem);

  std::vector<char> held_, fixed_;  // by place
};

extern template struct QuadraticForm<2>;
extern template struct QuadraticForm<3>;

}  // namespace pose_graph
