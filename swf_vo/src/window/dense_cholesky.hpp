// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "urban_nav_core/geometry/dense_kernels.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

namespace kernels = urban_nav_core::kernels;

/// A symmetric matrix of dynamic size, column-major; only the lower triangle is used (the upper one is undefined).
/// Reserves three times the required memory, and never shrinks.
class DenseMatrix {
 public:
  /// Resizes and sets to zero.
  void reset(int size);
  /// Resizes; the elements are undefined.
  void resize(int size);
  /// Reserves the capacity of another matrix, so that copies of it do not allocate.
  void reserveLike(const DenseMatrix& other) { data_.reserve(other.data_.capacity()); }
  int size() const { return size_; }
  int stride() const { return stride_; }
  double* column(int j) { return data_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_); }
  const double* column(int j) const {
    return data_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_);
  }
  double& operator()(int i, int j) { return column(j)[i]; }
  double operator()(int i, int j) const { return column(j)[i]; }
  void archive(urban_nav_core::Archive& archive);

 private:
  int size_ = 0;
  int stride_ = 0;
  std::vector<double> data_;
};

/// C[first, first + rows) -= B B^T, lower triangle, B column-major with its own stride. Requires `first` to be a
/// multiple of 8, and first + rows too unless it is the end of C. Keeps its buffer.
class StripProduct {
 public:
  explicit StripProduct(const kernels::InstructionSet& set = kernels::instructionSets().front()) : set_(set) {}

  void subtract(DenseMatrix& C, int first, int rows, const double* B, int columns, int stride);

 private:
  kernels::InstructionSet set_;
  std::vector<double> packed_;
};

/// L L^T = A for a positive semidefinite A. If a pivot falls below 1e-12 of its diagonal element, its direction is not
/// determined by the preceding ones. It is held: solutions leave component j unchanged, and its pivot becomes floor[j]
/// (an information) so that covariances remain valid. This does not add information to the system.
class DenseCholesky {
 public:
  explicit DenseCholesky(const kernels::InstructionSet& set = kernels::instructionSets().front()) : set_(set) {}

  /// Overwrites A with L; A must outlive the solves.
  void factor(DenseMatrix& A, const std::vector<double>& floor);

  /// Solves L x = b and L^T x = b in place, from component `first` on (earlier ones are unchanged).
  void solveLower(double* x, int first = 0) const;
  void solveUpper(double* x, int first = 0) const;
  /// Solves L^T x = b for six columns, `stride` elements apart.
  void solveUpperSix(double* x, int stride) const;

  /// Sets held components to zero: called between solveLower and solveUpper, the solution leaves them unchanged.
  void release(double* x) const;

  int heldCount() const { return held_count_; }

  /// Archives the factorisation together with the factor, which is in A as passed to factor().
  void archive(urban_nav_core::Archive& archive, DenseMatrix& A);

 private:
  void factorDiagonal(DenseMatrix& A, int start, int width, const std::vector<double>& floor);

  kernels::InstructionSet set_;
  const DenseMatrix* L_ = nullptr;
  std::vector<double> diagonal_, block_, inverse_, packed_;
  std::vector<char> held_;
  int held_count_ = 0;
};

}  // namespace swf_vo
