// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/dense_kernels.hpp"

namespace pose_graph {

/// The dense piece that a multifrontal factorisation works on: a symmetric matrix (lower triangle, column-major), of
/// which the leading columns are eliminated. Its room is rounded up so that kernels may work on whole tiles of 8x8.
/// Keeps its buffers.
class Front {
 public:
  /// All zero, of this size.
  void reset(int size);
  int size() const { return size_; }
  int stride() const { return stride_; }
  double* column(int j) { return data_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_); }
  const double* column(int j) const {
    return data_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_);
  }

  /// The first `pivots` columns become those of the Cholesky factor, and what is below and right of them their Schur
  /// complement. False where a pivot is not positive (or NaN); the front is then spoilt.
  bool eliminate(int pivots);

  /// For a matrix that may be singular: what its pivots are measured by, and which columns had to be pinned.
  struct Pins {
    std::vector<double> size;  ///< of each pivot in the matrix as it was given, above zero
    std::vector<int> columns;
  };
  /// The same of the matrix with kPin times its size added to each pivot of which next to nothing is left.
  bool eliminate(int pivots, Pins* pins);
  static constexpr double kPin = 1e-6;

 private:
  bool eliminateDiagonal(int start, int width, Pins* pins);

  int size_ = 0, stride_ = 0;
  std::vector<double> data_, packed_, lower_, inverse_;
  urban_nav_core::kernels::InstructionSet kernels_ = urban_nav_core::kernels::instructionSets().front();
};

}  // namespace pose_graph
