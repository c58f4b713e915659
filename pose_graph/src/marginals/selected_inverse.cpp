// SPDX-License-Identifier: BSD-3-Clause
#include "marginals/selected_inverse.hpp"

#include <cassert>

#include "linear/index.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The inverse on the columns and rows of the ancestors of the current supernode, kept while a descendant needs it.
class Ancestors {
 public:
  Eigen::Map<const MatrixXd> last() const {
    const Index size = sizes_.back();
    return {numbers_.data() + numbers_.size() - static_cast<std::size_t>(size * size), size, size};
  }
  void push(const MatrixXd& inverse) {
    numbers_.insert(numbers_.end(), inverse.data(), inverse.data() + inverse.size());
    sizes_.push_back(inverse.rows());
  }
  void pop() {
    numbers_.resize(numbers_.size() - static_cast<std::size_t>(sizes_.back() * sizes_.back()));
    sizes_.pop_back();
  }

 private:
  std::vector<double> numbers_;
  std::vector<Index> sizes_;
};

// Completes the inverse on a supernode. With L = [L_c; L_r] its columns, W = L_c^-T L_r^T and S the inverse on the rows
// below, the inverse is [L_c^-T L_c^-1 + W S W^T, -W S; ., S].
void complete(MatrixXd& inverse, const Eigen::Map<const MatrixXd>& panel) {
  using namespace urban_nav_core;
  const Index columns = panel.cols(), rows = panel.rows() - columns;
  const auto L = panel.topRows(columns);
  MatrixXd own = MatrixXd::Identity(columns, columns);
  solveLowerInPlace(L, own);
  solveLowerTransposedInPlace(L, own);
  if (rows > 0) {
    MatrixXd W = panel.bottomRows(rows).transpose();
    solveLowerTransposedInPlace(L, W);
    auto cross = inverse.topRightCorner(columns, rows);
    cross.noalias() = -W * inverse.bottomRightCorner(rows, rows);
    own.noalias() -= cross * W.transpose();
    inverse.bottomLeftCorner(rows, columns) = cross.transpose();
  }
  inverse.topLeftCorner(columns, columns) = 0.5 * (own + own.transpose());
}

}  // namespace

template <int B>
BlockMatrix<B> selectedInverse(const BlockCholesky<B>& cholesky, const BlockPattern& pattern) {
  const Symbolic& shape = cholesky.symbolic();
  BlockMatrix<B> made;
  made.setZero(pattern);
  std::vector<int> first_child(sz(shape.size()), -1);
  for (int s = shape.size() - 1; s >= 0; --s)
    if (shape.parent[sz(s)] >= 0) first_child[sz(shape.parent[sz(s)])] = s;
  // In reverse postorder each supernode follows its parent, and the last child visited is the first one in postorder.
  Ancestors ancestors;
  std::vector<int> local(shape.node.size(), 0);
  MatrixXd inverse;
  for (int s = shape.size() - 1; s >= 0; --s) {
    const int begin = shape.begin[sz(s)], columns = shape.columns(s), rows = shape.rowsBelow(s);
    const int* row = shape.rows.data() + shape.row_begin[sz(s)];
    inverse.resize(B * (columns + rows), B * (columns + rows));
    if (rows > 0) {
      const int parent = shape.parent[sz(s)], parent_begin = shape.begin[sz(parent)];
      // `local` still holds positions in another supernode: compute those in the parent.
      const int* above = shape.rows.data() + shape.row_begin[sz(parent)];
      int at = 0;
      for (int r = 0; r < rows; ++r) {
        if (row[r] < shape.begin[sz(parent) + 1]) {
          local[sz(row[r])] = row[r] - parent_begin;
        } else {
          while (above[at] != row[r]) ++at;
          local[sz(row[r])] = shape.columns(parent) + at;
        }
      }
      const auto known = ancestors.last();
      for (int c = 0; c < rows; ++c)
        for (int r = 0; r < rows; ++r)
          inverse.block<B, B>(B * (columns + r), B * (columns + c)) =
              known.template block<B, B>(B * local[sz(row[r])], B * local[sz(row[c])]);
      if (first_child[sz(parent)] == s) ancestors.pop();
    }
    complete(inverse, {cholesky.panel(s), B * (columns + rows), B * columns});
    if (first_child[sz(s)] >= 0) ancestors.push(inverse);
    for (int c = 0; c < columns; ++c) local[sz(begin + c)] = c;
    for (int r = 0; r < rows; ++r) local[sz(row[r])] = columns + r;
    for (int c = 0; c < columns; ++c) {
      made.diagonal[sz(begin + c)] = inverse.block<B, B>(B * c, B * c);
      for (int e = pattern.first[sz(begin + c)]; e < pattern.first[sz(begin + c) + 1]; ++e)
        made.lower[sz(e)] = inverse.block<B, B>(B * local[sz(pattern.row[sz(e)])], B * c);
    }
  }
  return made;
}

template BlockMatrix<2> selectedInverse<2>(const BlockCholesky<2>&, const BlockPattern&);
template BlockMatrix<3> selectedInverse<3>(const BlockCholesky<3>&, const BlockPattern&);
template BlockMatrix<6> selectedInverse<6>(const BlockCholesky<6>&, const BlockPattern&);

}  // namespace pose_graph
