// SPDX-License-Identifier: BSD-3-Clause
#include "linear/block_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "linear/index.hpp"

namespace pose_graph {

namespace {

// Returns the reference size of a diagonal entry; one if it is zero, where any reference is valid.
double toSize(double entry) { return entry > 0.0 ? entry : 1.0; }

}  // namespace

template <int B>
BlockCholesky<B>::BlockCholesky(const Symbolic& symbolic) : symbolic_(&symbolic) {
  const int n = symbolic.size();
  std::size_t total = 0;
  offset_.reserve(sz(n));
  for (int s = 0; s < n; ++s) {
    offset_.push_back(total);
    total += sz(panelRows(s)) * sz(B * symbolic.columns(s));
  }
  panels_.resize(total);
  first_child_.assign(sz(n), -1);
  next_sibling_.assign(sz(n), -1);
  for (int s = n - 1; s >= 0; --s) {
    const int parent = symbolic.parent[sz(s)];
    if (parent < 0) continue;
    next_sibling_[sz(s)] = first_child_[sz(parent)];
    first_child_[sz(parent)] = s;
  }
  // In postorder the children's complements are the last ones in pending_; their parent's complement replaces them.
  update_.assign(sz(n), 0);
  std::size_t end = 0, most = 0;
  for (int s = 0; s < n; ++s) {
    for (int child = first_child_[sz(s)]; child >= 0; child = next_sibling_[sz(child)])
      end = std::min(end, update_[sz(child)]);
    update_[sz(s)] = end;
    const std::size_t side = sz(B * symbolic.rowsBelow(s));
    end += side * (side + 1) / 2;
    most = std::max(most, end);
  }
  pending_.resize(most);
  local_.assign(symbolic.node.size(), 0);
}

template <int B>
void BlockCholesky<B>::assemble(int s, const BlockMatrix<B>& A, const BlockPattern& pattern) {
  const Symbolic& shape = *symbolic_;
  const int begin = shape.begin[sz(s)], columns = shape.columns(s);
  for (int c = 0; c < columns; ++c) {
    const int place = begin + c;
    for (int j = 0; j < B; ++j) {
      double* column = front_.column(c * B + j);
      const auto& block = A.diagonal[sz(place)];
      for (int i = j; i < B; ++i) column[c * B + i] += block(i, j);
    }
    for (int e = pattern.first[sz(place)]; e < pattern.first[sz(place) + 1]; ++e) {
      const auto& block = A.lower[sz(e)];
      const int row = B * local_[sz(pattern.row[sz(e)])];
      for (int j = 0; j < B; ++j) {
        double* column = front_.column(c * B + j) + row;
        for (int i = 0; i < B; ++i) column[i] += block(i, j);
      }
    }
  }
}

template <int B>
void BlockCholesky<B>::addChild(int child) {
  const Symbolic& shape = *symbolic_;
  runs_.clear();
  for (int r = shape.row_begin[sz(child)]; r < shape.row_begin[sz(child) + 1]; ++r) {
    const int row = B * local_[sz(shape.rows[sz(r)])];
    if (!runs_.empty() && runs_.back().row + runs_.back().length == row) runs_.back().length += B;
    else runs_.push_back({row, B});
  }
  const double* source = pending_.data() + update_[sz(child)];
  const auto add = [&source](double* target, int length) {
    if (length < 16) {  // for short runs, a loop is faster than a mapped vector
      for (int i = 0; i < length; ++i) target[i] += source[i];
    } else {
      Eigen::Map<Eigen::VectorXd>(target, length) += Eigen::Map<const Eigen::VectorXd>(source, length);
    }
    source += length;
  };
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const int end = runs_[run].row + runs_[run].length;
    for (int j = runs_[run].row; j < end; ++j) {
      double* column = front_.column(j);
      add(column + j, end - j);
      for (std::size_t below = run + 1; below < runs_.size(); ++below)
        add(column + runs_[below].row, runs_[below].length);
    }
  }
}

template <int B>
bool BlockCholesky<B>::factor(const BlockMatrix<B>& A, const BlockPattern& pattern) {
  return factor(A, pattern, nullptr);
}

template <int B>
bool BlockCholesky<B>::factorPinned(const BlockMatrix<B>& A, const BlockPattern& pattern, std::vector<int>& pinned) {
  pinned.clear();
  return factor(A, pattern, &pinned);
}

template <int B>
double BlockCholesky<B>::computePin(const BlockMatrix<B>& A, int entry) {
  return Front::kPin * toSize(A.diagonal[sz(entry / B)](entry % B, entry % B));
}

template <int B>
bool BlockCholesky<B>::factor(const BlockMatrix<B>& A, const BlockPattern& pattern, std::vector<int>* pinned) {
  const Symbolic& shape = *symbolic_;
  for (int s = 0; s < shape.size(); ++s) {
    const int begin = shape.begin[sz(s)], columns = shape.columns(s), rows = shape.rowsBelow(s);
    for (int c = 0; c < columns; ++c) local_[sz(begin + c)] = c;
    for (int r = 0; r < rows; ++r) local_[sz(shape.rows[sz(shape.row_begin[sz(s)] + r)])] = columns + r;
    front_.reset(B * (columns + rows));
    assemble(s, A, pattern);
    for (int child = first_child_[sz(s)]; child >= 0; child = next_sibling_[sz(child)]) addChild(child);
    if (pinned == nullptr) {
      if (!front_.eliminate(B * columns)) return false;
    } else {
      Front::Pins pins;
      for (int j = 0; j < B * columns; ++j) pins.size.push_back(toSize(A.diagonal[sz(begin + j / B)](j % B, j % B)));
      if (!front_.eliminate(B * columns, &pins)) return false;
      for (const int column : pins.columns) pinned->push_back(B * begin + column);
    }

    double* panel = panels_.data() + offset_[sz(s)];
    const int height = panelRows(s);
    for (int j = 0; j < B * columns; ++j, panel += height)
      std::memcpy(panel, front_.column(j), sz(height) * sizeof(double));
    double* update = pending_.data() + update_[sz(s)];
    for (int j = B * columns; j < height; update += height - j, ++j)
      std::memcpy(update, front_.column(j) + j, sz(height - j) * sizeof(double));
  }
  return true;
}

template <int B>
void BlockCholesky<B>::forward(int s, double* x) const {
  const Symbolic& shape = *symbolic_;
  const int pivots = B * shape.columns(s), height = panelRows(s), rows = height - pivots;
  const double* L = panel(s);
  double* y = x + sz(B * shape.begin[sz(s)]);
  const double* column = L;
  for (int j = 0; j < pivots; ++j, column += height) {
    y[j] /= column[j];
    kernels_.subtract(y + j + 1, column + j + 1, y[j], pivots - j - 1);
  }
  gathered_.assign(sz(rows), 0.0);
  const double* below = L + pivots;
  int j = 0;
  for (; j + 3 <= pivots; j += 3, below += 3 * height)
    kernels_.subtractThree(gathered_.data(), below, below + height, below + 2 * height, y + j, rows);
  for (; j < pivots; ++j, below += height) kernels_.subtract(gathered_.data(), below, y[j], rows);
  const double* change = gathered_.data();
  for (int r = shape.row_begin[sz(s)]; r < shape.row_begin[sz(s) + 1]; ++r, change += B) {
    double* target = x + sz(B * shape.rows[sz(r)]);
    for (int i = 0; i < B; ++i) target[i] += change[i];
  }
}

template <int B>
void BlockCholesky<B>::backward(int s, double* x) const {
  const Symbolic& shape = *symbolic_;
  const int pivots = B * shape.columns(s), height = panelRows(s), rows = height - pivots;
  const double* L = panel(s);
  double* y = x + sz(B * shape.begin[sz(s)]);
  gathered_.resize(sz(rows));
  double* gathered = gathered_.data();
  for (int r = shape.row_begin[sz(s)]; r < shape.row_begin[sz(s) + 1]; ++r, gathered += B)
    std::memcpy(gathered, x + sz(B * shape.rows[sz(r)]), B * sizeof(double));
  const double* below = L + pivots;
  int j = 0;
  for (; j + 6 <= pivots; j += 6, below += 6 * height) {
    double products[6];
    kernels_.dotSix(gathered_.data(), below, height, rows, products);
    for (int k = 0; k < 6; ++k) y[j + k] -= products[k];
  }
  for (; j < pivots; ++j, below += height) y[j] -= kernels_.dot(gathered_.data(), below, rows);
  for (j = pivots - 1; j >= 0; --j) {
    const double* column = L + sz(j) * sz(height);
    y[j] = (y[j] - kernels_.dot(column + j + 1, y + j + 1, pivots - j - 1)) / column[j];
  }
}

template <int B>
void BlockCholesky<B>::solve(double* x, int columns) const {
  const std::size_t length = sz(B) * symbolic_->node.size();
  for (int s = 0; s < symbolic_->size(); ++s)
    for (int right = 0; right < columns; ++right) forward(s, x + sz(right) * length);
  for (int s = symbolic_->size() - 1; s >= 0; --s)
    for (int right = 0; right < columns; ++right) backward(s, x + sz(right) * length);
}

template <int B>
void BlockCholesky<B>::forwardEight(int s, double* x) const {
  const Symbolic& shape = *symbolic_;
  const int pivots = B * shape.columns(s), height = panelRows(s), rows = height - pivots;
  const double* L = panel(s);
  double* y = x + sz(8 * B * shape.begin[sz(s)]);
  for (int begin = 0; begin < pivots; begin += B) {
    kernels_.subtractEight(y + 8 * begin, B, L + begin, 1, height, y, begin);
    for (int j = begin; j < begin + B; ++j) {
      const double* column = L + sz(j) * sz(height);
      for (int c = 0; c < 8; ++c) y[8 * j + c] /= column[j];
      for (int i = j + 1; i < begin + B; ++i)
        for (int c = 0; c < 8; ++c) y[8 * i + c] -= column[i] * y[8 * j + c];
    }
  }
  gathered_.assign(sz(8 * rows), 0.0);
  kernels_.subtractEight(gathered_.data(), rows, L + pivots, 1, height, y, pivots);
  const double* change = gathered_.data();
  for (int r = shape.row_begin[sz(s)]; r < shape.row_begin[sz(s) + 1]; ++r, change += 8 * B) {
    double* target = x + sz(8 * B * shape.rows[sz(r)]);
    for (int i = 0; i < 8 * B; ++i) target[i] += change[i];
  }
}

template <int B>
void BlockCholesky<B>::backwardEight(int s, double* x) const {
  const Symbolic& shape = *symbolic_;
  const int pivots = B * shape.columns(s), height = panelRows(s), rows = height - pivots;
  const double* L = panel(s);
  double* y = x + sz(8 * B * shape.begin[sz(s)]);
  gathered_.resize(sz(8 * rows));
  double* gathered = gathered_.data();
  for (int r = shape.row_begin[sz(s)]; r < shape.row_begin[sz(s) + 1]; ++r, gathered += 8 * B)
    std::memcpy(gathered, x + sz(8 * B * shape.rows[sz(r)]), 8 * B * sizeof(double));
  kernels_.subtractEight(y, pivots, L + pivots, height, 1, gathered_.data(), rows);
  for (int begin = pivots - B; begin >= 0; begin -= B) {
    const int end = begin + B;
    kernels_.subtractEight(y + 8 * begin, B, L + sz(begin) * sz(height) + end, height, 1, y + 8 * end, pivots - end);
    for (int j = end - 1; j >= begin; --j) {
      const double* column = L + sz(j) * sz(height);
      for (int i = j + 1; i < end; ++i)
        for (int c = 0; c < 8; ++c) y[8 * j + c] -= column[i] * y[8 * i + c];
      for (int c = 0; c < 8; ++c) y[8 * j + c] /= column[j];
    }
  }
}

template <int B>
void BlockCholesky<B>::solveEight(double* x) const {
  for (int s = 0; s < symbolic_->size(); ++s) forwardEight(s, x);
  for (int s = symbolic_->size() - 1; s >= 0; --s) backwardEight(s, x);
}

// Computes the columns of L^-1 for one place: B right-hand sides, nonzero only along the path to the root.
template <int B>
void BlockCholesky<B>::halfColumns(int place, std::vector<double>& x) const {
  const std::size_t length = sz(B) * symbolic_->node.size();
  if (x.empty()) x.assign(B * length, 0.0);
  for (std::size_t k = 0; k < B; ++k) x[k * length + sz(B * place) + k] = 1.0;
  for (int s = symbolic_->supernode[sz(place)]; s >= 0; s = symbolic_->parent[sz(s)])
    for (std::size_t k = 0; k < B; ++k) forward(s, x.data() + k * length);
}

template <int B>
typename BlockMatrix<B>::Block BlockCholesky<B>::inverseBlock(int row, int column) const {
  const Symbolic& shape = *symbolic_;
  const Eigen::Index length = B * static_cast<Eigen::Index>(shape.node.size());
  halfColumns(row, row_half_);
  halfColumns(column, column_half_);
  typename BlockMatrix<B>::Block made = BlockMatrix<B>::Block::Zero();
  // A^-1 = L^-T L^-1; both columns are nonzero on the common part of their paths.
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, B>> left(row_half_.data(), length, B),
      right(column_half_.data(), length, B);
  for (int s = shape.supernode[sz(column)]; s >= 0; s = shape.parent[sz(s)])
    for (Eigen::Index i = B * shape.begin[sz(s)]; i < B * shape.begin[sz(s) + 1]; ++i)
      made += left.row(i).transpose() * right.row(i);
  for (const int place : {row, column})
    for (int s = shape.supernode[sz(place)]; s >= 0; s = shape.parent[sz(s)]) {
      left.middleRows(B * shape.begin[sz(s)], B * shape.columns(s)).setZero();
      right.middleRows(B * shape.begin[sz(s)], B * shape.columns(s)).setZero();
    }
  return made;
}

template <int B>
double BlockCholesky<B>::logDeterminant() const {
  double sum = 0.0;
  for (int s = 0; s < symbolic_->size(); ++s) {
    const int height = panelRows(s);
    for (int j = 0; j < B * symbolic_->columns(s); ++j) sum += std::log(panel(s)[sz(j) * sz(height) + sz(j)]);
  }
  return 2.0 * sum;
}

template class BlockCholesky<2>;
template class BlockCholesky<3>;
template class BlockCholesky<4>;
template class BlockCholesky<6>;

}  // namespace pose_graph
