// SPDX-License-Identifier: BSD-3-Clause
#include "linear/block_cholesky.hpp"

#include <algorithm>
#include <cstring>

namespace pose_graph {

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

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
  update_.assign(sz(n), 0);
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
void BlockCholesky<B>::addChild(int child, int s) {
  const Symbolic& shape = *symbolic_;
  const int rows = shape.rowsBelow(child), stride = rows * B;
  const double* update = pending_.data() + update_[sz(child)];
  child_local_.resize(sz(rows));
  for (int r = 0; r < rows; ++r) child_local_[sz(r)] = B * local_[sz(shape.rows[sz(shape.row_begin[sz(child)] + r)])];
  (void)s;
  for (int c = 0; c < rows; ++c) {
    for (int j = 0; j < B; ++j) {
      const double* source = update + sz(c * B + j) * sz(stride);
      double* target = front_.column(child_local_[sz(c)] + j);
      for (int r = c; r < rows; ++r) {
        double* to = target + child_local_[sz(r)];
        const double* from = source + r * B;
        for (int i = 0; i < B; ++i) to[i] += from[i];
      }
    }
  }
}

template <int B>
bool BlockCholesky<B>::factor(const BlockMatrix<B>& A, const BlockPattern& pattern) {
  const Symbolic& shape = *symbolic_;
  pending_end_ = 0;
  for (int s = 0; s < shape.size(); ++s) {
    const int begin = shape.begin[sz(s)], columns = shape.columns(s), rows = shape.rowsBelow(s);
    for (int c = 0; c < columns; ++c) local_[sz(begin + c)] = c;
    for (int r = 0; r < rows; ++r) local_[sz(shape.rows[sz(shape.row_begin[sz(s)] + r)])] = columns + r;
    front_.reset(B * (columns + rows));
    assemble(s, A, pattern);
    std::size_t free_from = pending_end_;
    for (int child = first_child_[sz(s)]; child >= 0; child = next_sibling_[sz(child)]) {
      addChild(child, s);
      free_from = std::min(free_from, update_[sz(child)]);
    }
    pending_end_ = free_from;  // in postorder the children's complements are the last ones
    if (!front_.eliminate(B * columns)) return false;

    double* panel = panels_.data() + offset_[sz(s)];
    const std::size_t height = sz(B * (columns + rows));
    for (int j = 0; j < B * columns; ++j)
      std::memcpy(panel + sz(j) * height, front_.column(j), height * sizeof(double));
    const std::size_t side = sz(B * rows);
    update_[sz(s)] = pending_end_;
    if (pending_.size() < pending_end_ + side * side) pending_.resize(pending_end_ + side * side);
    double* update = pending_.data() + pending_end_;
    for (std::size_t j = 0; j < side; ++j)
      std::memcpy(update + j * side + j, front_.column(B * columns + static_cast<int>(j)) + sz(B * columns) + j,
                  (side - j) * sizeof(double));
    pending_end_ += side * side;
  }
  return true;
}

template <int B>
void BlockCholesky<B>::solve(double* x, int columns) const {
  const Symbolic& shape = *symbolic_;
  const std::size_t length = sz(B) * shape.node.size();
  for (int right = 0; right < columns; ++right, x += length) {
    for (int s = 0; s < shape.size(); ++s) {
      const int pivots = B * shape.columns(s), height = panelRows(s), rows = shape.rowsBelow(s);
      const double* L = panel(s);
      double* y = x + sz(B * shape.begin[sz(s)]);
      gathered_.assign(sz(height - pivots), 0.0);
      for (int j = 0; j < pivots; ++j) {
        const double* column = L + sz(j) * sz(height);
        const double value = y[j] /= column[j];
        for (int i = j + 1; i < pivots; ++i) y[i] -= column[i] * value;
        const double* below = column + pivots;
        for (int i = 0; i < height - pivots; ++i) gathered_[sz(i)] += below[i] * value;
      }
      for (int r = 0; r < rows; ++r) {
        double* target = x + sz(B * shape.rows[sz(shape.row_begin[sz(s)] + r)]);
        for (int i = 0; i < B; ++i) target[i] -= gathered_[sz(r * B + i)];
      }
    }
    for (int s = shape.size() - 1; s >= 0; --s) {
      const int pivots = B * shape.columns(s), height = panelRows(s), rows = shape.rowsBelow(s);
      const double* L = panel(s);
      double* y = x + sz(B * shape.begin[sz(s)]);
      gathered_.resize(sz(height - pivots));
      for (int r = 0; r < rows; ++r)
        std::memcpy(&gathered_[sz(r * B)], x + sz(B * shape.rows[sz(shape.row_begin[sz(s)] + r)]), B * sizeof(double));
      for (int j = pivots - 1; j >= 0; --j) {
        const double* column = L + sz(j) * sz(height);
        double sum = y[j];
        for (int i = j + 1; i < pivots; ++i) sum -= column[i] * y[i];
        const double* below = column + pivots;
        for (int i = 0; i < height - pivots; ++i) sum -= below[i] * gathered_[sz(i)];
        y[j] = sum / column[j];
      }
    }
  }
}

template class BlockCholesky<2>;
template class BlockCholesky<3>;
template class BlockCholesky<6>;

}  // namespace pose_graph
