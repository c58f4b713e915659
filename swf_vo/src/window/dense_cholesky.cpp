// SPDX-License-Identifier: BSD-3-Clause
#include "window/dense_cholesky.hpp"

#include <algorithm>
#include <cmath>

namespace swf_vo {

namespace {

// Rounding leaves about 1e-15 of the diagonal; what lies a thousand times above it is taken for information.
constexpr double relative_limit = 1e-12;
constexpr int block = 32;

}  // namespace

void DenseMatrix::reset(int size) {
  size_ = size;
  stride_ = (size + 7) / 8 * 8;
  const std::size_t needed = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(size);
  if (data_.size() < needed) data_.resize(std::max(needed, 2 * data_.size()));
  std::fill(data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(needed), 0.0);
}

void subtractProduct(DenseMatrix& C, int first, int rows, const double* B, int columns, int stride) {
  for (int j = 0; j < rows; ++j) {
    double* c = C.column(first + j) + first;
    for (int k = 0; k < columns; ++k) {
      const double* b = B + static_cast<std::size_t>(k) * static_cast<std::size_t>(stride);
      const double factor = b[j];
      if (factor == 0.0) continue;
      for (int i = j; i < rows; ++i) c[i] -= b[i] * factor;
    }
  }
}

void DenseCholesky::factor(DenseMatrix& A, const std::vector<double>& floor) {
  const int n = A.size();
  L_ = &A;
  held_count_ = 0;
  held_.assign(static_cast<std::size_t>(n), 0);
  diagonal_.resize(static_cast<std::size_t>(n));
  for (int j = 0; j < n; ++j) diagonal_[static_cast<std::size_t>(j)] = A(j, j);
  for (int start = 0; start < n; start += block) {
    const int end = std::min(n, start + block);
    for (int j = start; j < end; ++j) {
      double* column = A.column(j);
      for (int k = start; k < j; ++k) {
        const double* left = A.column(k);
        const double factor = left[j];
        for (int i = j; i < n; ++i) column[i] -= left[i] * factor;
      }
      const std::size_t at = static_cast<std::size_t>(j);
      if (!(column[j] > relative_limit * diagonal_[at]) || !(column[j] > 0.0)) {
        held_[at] = 1;
        ++held_count_;
        std::fill(column + j, column + n, 0.0);
        column[j] = std::sqrt(floor[at]);
        continue;
      }
      const double pivot = std::sqrt(column[j]);
      const double inverse = 1.0 / pivot;
      for (int i = j + 1; i < n; ++i) column[i] *= inverse;
      column[j] = pivot;
    }
    if (end < n) subtractProduct(A, end, n - end, A.column(start) + end, end - start, A.stride());
  }
}

void DenseCholesky::solveLower(double* x, int first) const {
  const int n = L_->size();
  for (int j = first; j < n; ++j) {
    const double* column = L_->column(j);
    x[j] = x[j] / column[j];
    const double value = x[j];
    if (value == 0.0) continue;
    for (int i = j + 1; i < n; ++i) x[i] -= column[i] * value;
  }
}

void DenseCholesky::solveUpper(double* x, int first) const {
  for (int j = L_->size() - 1; j >= first; --j) {
    const double* column = L_->column(j);
    double sum = 0.0;
    for (int i = j + 1; i < L_->size(); ++i) sum += column[i] * x[i];
    x[j] = (x[j] - sum) / column[j];
  }
}

void DenseCholesky::release(double* x) const {
  for (std::size_t j = 0; j < held_.size(); ++j)
    if (held_[j]) x[j] = 0.0;
}

}  // namespace swf_vo
