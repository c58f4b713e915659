// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linear/block_matrix.hpp"
#include "linear/front.hpp"

namespace pose_graph {

/// Sparse Cholesky factorisation of a symmetric positive definite matrix of BxB blocks, supernodal and multifrontal
/// (Duff, Reid, ACM TOMS 1983; Liu, SIAM Review 1992). Own code: it takes blocks where they are, needs one symbolic
/// analysis for blocks of every size, gives the same bits on every machine, and lets marginal covariances be read off
/// its supernodes. Compiled for B = 2, 3, 4, 6. Keeps its buffers; not thread-safe.
template <int B>
class BlockCholesky {
 public:
  /// `symbolic` must outlive it.
  explicit BlockCholesky(const Symbolic& symbolic);

  /// False where A is not positive definite to working precision, or holds NaN.
  bool factor(const BlockMatrix<B>& A, const BlockPattern& pattern);

  /// The same for a matrix that may be singular: where nothing is left of a pivot, computePin() is added to that entry
  /// of the diagonal. The entries come in `pinned`, each as B times its place plus its row; empty: A is positive
  /// definite.
  bool factorPinned(const BlockMatrix<B>& A, const BlockPattern& pattern, std::vector<int>& pinned);
  static double computePin(const BlockMatrix<B>& A, int entry);

  /// x becomes A^-1 x for `columns` right-hand sides, one after another, each B numbers a place.
  void solve(double* x, int columns = 1) const;
  /// The same for eight right-hand sides that lie side by side, number r of side c at x[8 r + c]: several times as
  /// fast.
  void solveEight(double* x) const;

  /// The block of A^-1 in the row of one place and the column of another. Costs as much as there are supernodes above
  /// them.
  typename BlockMatrix<B>::Block inverseBlock(int row, int column) const;

  /// Logarithm of the determinant of A.
  double logDeterminant() const;

  const Symbolic& symbolic() const { return *symbolic_; }
  /// The columns of supernode s: columnMajor, (columns + rows) * B long, columns * B of them.
  const double* panel(int s) const { return panels_.data() + offset_[static_cast<std::size_t>(s)]; }
  int panelRows(int s) const { return B * (symbolic_->columns(s) + symbolic_->rowsBelow(s)); }

 private:
  void assemble(int s, const BlockMatrix<B>& A, const BlockPattern& pattern);
  void addChild(int child);
  bool factor(const BlockMatrix<B>& A, const BlockPattern& pattern, std::vector<int>* pinned);
  void forward(int s, double* x) const;
  void backward(int s, double* x) const;
  void forwardEight(int s, double* x) const;
  void backwardEight(int s, double* x) const;
  void halfColumns(int place, std::vector<double>& x) const;

  const Symbolic* symbolic_;
  std::vector<std::size_t> offset_;
  std::vector<double> panels_;
  std::vector<int> first_child_, next_sibling_;
  std::vector<std::size_t> update_;  // of each supernode, in pending_
  std::vector<double> pending_;      // Schur complements not yet taken by their parents: lower triangles, by columns
  std::vector<int> local_;           // of each place in the front at work

  /// Rows of a child that follow one another in the front too.
  struct Run {
    int row, length;
  };
  std::vector<Run> runs_;
  Front front_;
  mutable std::vector<double> gathered_;
  mutable std::vector<double> row_half_, column_half_;  // zero but while inverseBlock() is at work
  urban_nav_core::kernels::InstructionSet kernels_ = urban_nav_core::kernels::instructionSets().front();
};

extern template class BlockCholesky<2>;
extern template class BlockCholesky<3>;
extern template class BlockCholesky<4>;
extern template class BlockCholesky<6>;

}  // namespace pose_graph
