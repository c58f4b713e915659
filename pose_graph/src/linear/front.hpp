// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/dense_kernels.hpp"

namespace pose_graph {

/// The dense frontal matrix of a multifrontal factorisation: symmetric (lower triangle, column-major); its leading
/// columns are eliminated. The storage is rounded up to whole 8x8 tiles for the kernels. Keeps its buffers.
class Front {
 public:
  /// Sets the size; all entries are zero.
  void reset(int size);
  int size() const { return size_; }
  int stride() const { return stride_; }
  double* column(int j) { return data_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_); }
  const double* column(int j) const {
    return data_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_);
  }

  /// Replaces the first `pivots` columns by those of the Cholesky factor, and the remaining lower right part by its
  /// Schur complement. Returns false, with invalid contents, if a pivot is not positive (or NaN).
  bool eliminate(int pivots);

  /// For a matrix that may be singular: reference sizes of pivots, and the columns that were pinned.
  struct Pins {
    std::vector<double> size;  ///< of each pivot: its size in the given matrix, positive
    std::vector<int> columns;
  };
  /// As above; adds kPin times the reference size to each vanishing pivot.
  bool eliminate(int pivots, Pins* pins);
  static constexpr double kPin = 1e-6;

 private:
  bool eliminateDiagonal(int start, int width, Pins* pins);

  int size_ = 0, stride_ = 0;
  std::vector<double> data_, packed_, lower_, inverse_;
  urban_nav_core::kernels::InstructionSet kernels_ = urban_nav_core::kernels::instructionSets().front();
};

}  // namespace pose_graph
