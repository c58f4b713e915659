// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linear/block_matrix.hpp"
#include "linear/front.hpp"

namespace pose_graph {

/// Sparse Cholesky factorisation of a symmetric positive definite matrix of BxB blocks, supernodal and multifrontal
/// (Duff, Reid, ACM TOMS 1983; Liu, SIAM Review 1992). Own implementation: it uses blocks in place, needs one symbolic
/// analysis for all block sizes, is bit-reproducible on every machine, and provides marginal covariances from its
/// supernodes. Instantiated for B = 2, 3, 4, 6. Not thread-safe: keeps buffers.
template <int B>
class BlockCholesky {
 public:
  /// `symbolic` must outlive this object.
  explicit BlockCholesky(const Symbolic& symbolic);

  /// Factors A. Returns false if A is not positive definite to working precision, or contains NaN.
  bool factor(const BlockMatrix<B>& A, const BlockPattern& pattern);

  /// Factors a matrix that may be singular. If a pivot vanishes, computePin() is added to that diagonal entry, and the
  /// entry is appended to `pinned` as B times its place plus its row. `pinned` stays empty if A is positive definite.
  bool factorPinned(const BlockMatrix<B>& A, const BlockPattern& pattern, std::vector<int>& pinned);
  static double computePin(const BlockMatrix<B>& A, int entry);

  /// Replaces x by A^-1 x for `columns` right-hand sides, one after another, with B numbers per place.
  void solve(double* x, int columns = 1) const;
  /// As solve(), for eight interleaved right-hand sides, row r of column c at x[8 r + c]: several times as fast.
  void solveEight(double* x) const;

  /// Returns the block of A^-1 at the row of one place and the column of another. Cost: linear in the number of
  /// supernodes above them.
  typename BlockMatrix<B>::Block inverseBlock(int row, int column) const;

  /// Returns the log determinant of A.
  double logDeterminant() const;

  const Symbolic& symbolic() const { return *symbolic_; }
  /// Returns the columns of supernode s: column-major, columns * B columns of length (columns + rows) * B.
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
  std::vector<std::size_t> update_;  // of each supernode: offset in pending_
  std::vector<double> pending_;      // Schur complements not yet added to their parents: lower triangles, by columns
  std::vector<int> local_;           // of each place: index in the current front

  /// Rows of a child that are also consecutive in the front.
  struct Run {
    int row, length;
  };
  std::vector<Run> runs_;
  Front front_;
  mutable std::vector<double> gathered_;
  mutable std::vector<double> row_half_, column_half_;  // zero except during inverseBlock()
  urban_nav_core::kernels::InstructionSet kernels_ = urban_nav_core::kernels::instructionSets().front();
};

extern template class BlockCholesky<2>;
extern template class BlockCholesky<3>;
extern template class BlockCholesky<4>;
extern template class BlockCholesky<6>;

}  // namespace pose_graph
