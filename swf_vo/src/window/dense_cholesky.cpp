// SPDX-License-Identifier: BSD-3-Clause
#include "window/dense_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

using kernels::kStrip;

namespace {

// Rounding errors are about 1e-15 of the diagonal; a value a thousand times larger counts as information.
constexpr double kLeastPivot = 1e-12;
// Columns of a panel: a packed strip (3 KB) and the strip it is multiplied with fit the first-level cache.
constexpr int kCholeskyPanel = 48;
constexpr int kLargestSize = 1 << 14;  // rows of an archived matrix

std::size_t rounded(int n) { return static_cast<std::size_t>((n + kStrip - 1) / kStrip * kStrip); }

// Packs rows [first, last) of column-major columns into strips; rows past the last are zero.
void pack(const double* columns, std::size_t stride, int first, int last, int depth, std::vector<double>& packed) {
  const std::size_t strips = rounded(last - first) / kStrip;
  const std::size_t size = static_cast<std::size_t>(kStrip) * static_cast<std::size_t>(depth);
  reserveWithHeadroom(packed, strips * size);
  if (packed.size() < strips * size) packed.resize(strips * size);
  for (std::size_t s = 0; s < strips; ++s) {
    const int row = first + static_cast<int>(s) * kStrip;
    const int rows = std::min(kStrip, last - row);
    for (int k = 0; k < depth; ++k) {
      double* to = packed.data() + s * size + static_cast<std::size_t>(k * kStrip);
      const double* from = columns + static_cast<std::size_t>(k) * stride + row;
      if (rows == kStrip) {
        std::memcpy(to, from, kStrip * sizeof(double));
        continue;
      }
      for (int r = 0; r < rows; ++r) to[r] = from[r];
      for (int r = rows; r < kStrip; ++r) to[r] = 0.0;
    }
  }
}

}  // namespace

void DenseMatrix::resize(int size) {
  size_ = size;
  stride_ = static_cast<int>(rounded(size));
  // With a power of two, all columns would map to the same cache lines.
  if (stride_ % 64 == 0) stride_ += kStrip;
  const std::size_t needed = static_cast<std::size_t>(stride_) * rounded(size);
  reserveWithHeadroom(data_, needed);
  if (data_.size() < needed) data_.resize(needed);
}

void DenseMatrix::reset(int size) {
  resize(size);
  for (int j = 0; j < size_; ++j) std::fill(column(j) + j, column(j) + size_, 0.0);
}

void StripProduct::subtract(DenseMatrix& C, int first, int rows, const double* B, int columns, int stride) {
  pack(B, static_cast<std::size_t>(stride), 0, rows, columns, packed_);
  set_.subtractStrips(C.column(first) + first, C.stride(), packed_.data(), static_cast<int>(rounded(rows)) / kStrip,
                      columns);
}

// Factors the diagonal block, row-major in `block_`, without blocking.
void DenseCholesky::factorDiagonal(DenseMatrix& A, int start, int width, const std::vector<double>& floor) {
  double* L = block_.data();
  for (int r = 0; r < width; ++r)
    for (int c = 0; c <= r; ++c) L[r * width + c] = A(start + r, start + c);
  for (int j = 0; j < width; ++j) {
    const std::size_t at = static_cast<std::size_t>(start + j);
    double* row = L + j * width;
    double pivot = row[j];
    for (int k = 0; k < j; ++k) pivot -= row[k] * row[k];
    const bool held = !(pivot > kLeastPivot * diagonal_[at]) || !(pivot > 0.0);
    held_[at] = held ? 1 : 0;
    held_count_ += held ? 1 : 0;
    row[j] = std::sqrt(held ? floor[at] : pivot);
    const double inverse = held ? 0.0 : 1.0 / row[j];
    inverse_[static_cast<std::size_t>(j)] = inverse;
    // Four rows at a time, since each difference depends on the previous one.
    int i = j + 1;
    for (; i + 4 <= width; i += 4) {
      double *a = L + i * width, *b = a + width, *c = b + width, *d = c + width;
      double va = a[j], vb = b[j], vc = c[j], vd = d[j];
      for (int k = 0; k < j; ++k) {
        va -= a[k] * row[k];
        vb -= b[k] * row[k];
        vc -= c[k] * row[k];
        vd -= d[k] * row[k];
      }
      a[j] = va * inverse;
      b[j] = vb * inverse;
      c[j] = vc * inverse;
      d[j] = vd * inverse;
    }
    for (; i < width; ++i) {
      double* below = L + i * width;
      double value = below[j];
      for (int k = 0; k < j; ++k) value -= below[k] * row[k];
      below[j] = value * inverse;
    }
  }
  for (int r = 0; r < width; ++r)
    for (int c = 0; c <= r; ++c) A(start + r, start + c) = L[r * width + c];
}

void DenseCholesky::factor(DenseMatrix& A, const std::vector<double>& floor) {
  const int n = A.size();
  L_ = &A;
  held_count_ = 0;
  reserveWithHeadroom(held_, static_cast<std::size_t>(n));
  reserveWithHeadroom(diagonal_, static_cast<std::size_t>(n));
  held_.assign(static_cast<std::size_t>(n), 0);
  diagonal_.resize(static_cast<std::size_t>(n));
  block_.resize(static_cast<std::size_t>(kCholeskyPanel * kCholeskyPanel));
  inverse_.resize(static_cast<std::size_t>(kCholeskyPanel));
  for (int j = 0; j < n; ++j) diagonal_[static_cast<std::size_t>(j)] = A(j, j);
  for (int start = 0; start < n; start += kCholeskyPanel) {
    const int width = std::min(kCholeskyPanel, n - start), end = start + width;
    factorDiagonal(A, start, width, floor);
    if (end == n) break;
    const int strips = static_cast<int>(rounded(n - end)) / kStrip;
    pack(A.column(start), static_cast<std::size_t>(A.stride()), end, n, width, packed_);
    set_.solveStrips(packed_.data(), strips, width, block_.data(), inverse_.data());
    for (int s = 0; s < strips; ++s)
      for (int k = 0; k < width; ++k) {
        const double* from = packed_.data() + static_cast<std::size_t>(s * width + k) * kStrip;
        std::memcpy(A.column(start + k) + end + s * kStrip, from, kStrip * sizeof(double));
      }
    set_.subtractStrips(A.column(end) + end, A.stride(), packed_.data(), strips, width);
  }
}

void DenseCholesky::solveLower(double* x, int first) const {
  const int n = L_->size();
  for (int j = first; j < n; ++j) {
    const double* column = L_->column(j);
    x[j] = x[j] / column[j];
    kernels::subtract(x + j + 1, column + j + 1, x[j], n - j - 1);
  }
}

void DenseCholesky::solveUpper(double* x, int first) const {
  for (int j = L_->size() - 1; j >= first; --j) {
    const double* column = L_->column(j);
    x[j] = (x[j] - kernels::dot(column + j + 1, x + j + 1, L_->size() - j - 1)) / column[j];
  }
}

void DenseCholesky::solveUpperSix(double* x, int stride) const {
  const int n = L_->size();
  double products[6];
  for (int j = n - 1; j >= 0; --j) {
    const double* column = L_->column(j);
    kernels::dotSix(column + j + 1, x + j + 1, stride, n - j - 1, products);
    for (int c = 0; c < 6; ++c) x[c * stride + j] = (x[c * stride + j] - products[c]) / column[j];
  }
}

void DenseCholesky::release(double* x) const {
  if (held_count_ == 0) return;
  for (std::size_t j = 0; j < held_.size(); ++j)
    if (held_[j]) x[j] = 0.0;
}

void DenseMatrix::archive(urban_nav_core::Archive& archive) {
  int size = size_;
  archive(size);
  if (archive.isReading()) {
    archive.require(size >= 0 && size <= kLargestSize, "matrix too large");
    resize(size);
  }
  std::vector<double> lower;
  for (int j = 0; j < size_; ++j) {
    lower.assign(column(j) + j, column(j) + size_);
    archive(lower);
    archive.require(lower.size() == static_cast<std::size_t>(size_ - j), "invalid column size");
    std::copy(lower.begin(), lower.end(), column(j) + j);
  }
}

void DenseCholesky::archive(urban_nav_core::Archive& archive, DenseMatrix& A) {
  archive(A, held_);
  archive.require(held_.size() == static_cast<std::size_t>(A.size()), "invalid size of a factor");
  if (!archive.isReading()) return;
  L_ = &A;
  held_count_ = static_cast<int>(std::count_if(held_.begin(), held_.end(), [](char held) { return held != 0; }));
}

}  // namespace swf_vo
