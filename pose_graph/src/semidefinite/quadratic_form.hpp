// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/block_cholesky.hpp"
#include "objective/objective.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

/// The chordal objective as a quadratic form: the cost is tr(X M X^T) for X = [t_1 R_1 t_2 R_2 ...]. M is symmetric and
/// positive semidefinite, with blocks of D + 1 (row and column 0 of a block: translation; the others: rotation). Rosen
/// et al., SE-Sync, IJRR 2019, eq. 13; translations are kept so that all matrices stay sparse.
template <int D>
struct QuadraticForm {
  static constexpr int kB = D + 1;
  using Block = Eigen::Matrix<double, kB, kB>;

  /// Edges with weight zero are left out; parts that only they connect are separate components.
  QuadraticForm(const Problem<D>& problem, const std::vector<double>& weights);
  QuadraticForm(const QuadraticForm&) = delete;
  QuadraticForm& operator=(const QuadraticForm&) = delete;

  /// Replaces rows and columns of A, which has M's pattern, by `pivot` on the diagonal: those of fixed poses, and the
  /// translation of the first pose of each component without fixed poses, which is free at no cost.
  void hold(BlockMatrix<kB>& A, double pivot) const;
  bool holdsTranslation(int place) const { return held_[static_cast<std::size_t>(place)] != 0; }
  bool isFixed(int place) const { return fixed_[static_cast<std::size_t>(place)] != 0; }

  std::vector<EdgeTerm<D>> terms;  ///< of the edges with weight; kappa and tau include the weights
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
