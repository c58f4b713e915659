// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/information.hpp"

#include <algorithm>
#include <cassert>
#include <ostream>

#include "urban_nav_core/geometry/dense.hpp"

namespace urban_nav_core {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Index> findIndices(const Information& information, const std::vector<Information::Name>& names) {
  std::vector<Index> indices;
  for (const auto name : names) {
    const Index begin = information.offset(name);
    const auto block = std::find_if(information.blocks().begin(), information.blocks().end(),
                                    [name](const Information::Block& each) { return each.name == name; });
    for (Index i = 0; i < block->size; ++i) indices.push_back(begin + i);
  }
  return indices;
}

std::vector<Information::Name> others(const Information& information, const std::vector<Information::Name>& removed) {
  std::vector<Information::Name> kept;
  for (const auto& block : information.blocks()) {
    if (std::find(removed.begin(), removed.end(), block.name) == removed.end()) kept.push_back(block.name);
  }
  return kept;
}

MatrixXd part(const MatrixXd& M, const std::vector<Index>& rows, const std::vector<Index>& columns) {
  MatrixXd out(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  for (Index c = 0; c < out.cols(); ++c) {
    for (Index r = 0; r < out.rows(); ++r)
      out(r, c) = M(rows[static_cast<std::size_t>(r)], columns[static_cast<std::size_t>(c)]);
  }
  return out;
}

VectorXd part(const VectorXd& v, const std::vector<Index>& rows) {
  VectorXd out(static_cast<Index>(rows.size()));
  for (Index r = 0; r < out.size(); ++r) out[r] = v[rows[static_cast<std::size_t>(r)]];
  return out;
}

}  // namespace

Information::Information(const std::vector<Block>& blocks) {
  for (const Block& block : blocks) append(block);
}

bool Information::contains(Name name) const {
  return std::any_of(blocks_.begin(), blocks_.end(), [name](const Block& each) { return each.name == name; });
}

Index Information::offset(Name name) const {
  Index at = 0;
  for (const Block& block : blocks_) {
    if (block.name == name) return at;
    at += block.size;
  }
  assert(false && "no block of this name");
  return 0;
}

MatrixXd Information::H(Name row, Name column) const {
  return part(H_, findIndices(*this, {row}), findIndices(*this, {column}));
}

VectorXd Information::b(Name name) const { return part(b_, findIndices(*this, {name})); }

void Information::append(const Block& block) {
  assert(!contains(block.name));
  const Index before = b_.size();
  const Index after = before + block.size;
  blocks_.push_back(block);
  H_.conservativeResize(after, after);
  H_.rightCols(block.size).setZero();
  H_.bottomRows(block.size).setZero();
  b_.conservativeResize(after);
  b_.tail(block.size).setZero();
}

void Information::add(const std::vector<Name>& names, const MatrixXd& H, const VectorXd& b) {
  const std::vector<Index> at = findIndices(*this, names);
  assert(H.rows() == H.cols() && b.size() == H.rows() && static_cast<Index>(at.size()) == b.size());
  for (Index c = 0; c < H.cols(); ++c) {
    const Index column = at[static_cast<std::size_t>(c)];
    for (Index r = 0; r < H.rows(); ++r) H_(at[static_cast<std::size_t>(r)], column) += H(r, c);
    b_[column] += b[c];
  }
}

void Information::add(const Information& other) {
  std::vector<Name> names;
  for (const Block& block : other.blocks_) {
    if (!contains(block.name)) append(block);
    names.push_back(block.name);
  }
  add(names, other.H_, other.b_);
}

Information Information::permuted(const std::vector<Name>& order) const {
  assert(order.size() == blocks_.size());
  const std::vector<Index> at = findIndices(*this, order);
  Information out;
  for (const Name name : order) {
    out.blocks_.push_back(
        *std::find_if(blocks_.begin(), blocks_.end(), [name](const Block& each) { return each.name == name; }));
  }
  out.H_ = part(H_, at, at);
  out.b_ = part(b_, at);
  return out;
}

std::optional<Information> Information::marginalised(const std::vector<Name>& removed) const {
  constexpr double kEmpty = 1e-12;
  const std::vector<Name> names = others(*this, removed);
  const std::vector<Index> keep = findIndices(*this, names), drop = findIndices(*this, removed);
  const auto inverse = pseudoInverse(part(H_, drop, drop), kEmpty);
  if (!inverse || !H_.allFinite() || !b_.allFinite()) return std::nullopt;
  const MatrixXd cross = part(H_, keep, drop);
  const MatrixXd gain = cross * *inverse;

  Information out;
  for (const Block& block : blocks_) {
    if (std::find(removed.begin(), removed.end(), block.name) == removed.end()) out.blocks_.push_back(block);
  }
  out.H_ = part(H_, keep, keep) - gain * cross.transpose();
  out.H_ = (0.5 * (out.H_ + out.H_.transpose())).eval();
  out.b_ = part(b_, keep) - gain * part(b_, drop);
  return out;
}

Information Information::conditioned(Name name, const VectorXd& value) const {
  const std::vector<Index> keep = findIndices(*this, others(*this, {name})), given = findIndices(*this, {name});
  assert(value.size() == static_cast<Index>(given.size()));
  Information out;
  for (const Block& block : blocks_) {
    if (block.name != name) out.blocks_.push_back(block);
  }
  out.H_ = part(H_, keep, keep);
  out.b_ = part(b_, keep) - part(H_, keep, given) * value;
  return out;
}

std::optional<VectorXd> Information::mean() const {
  MatrixXd L = H_;
  MatrixXd x = b_;
  if (!solvePositiveDefiniteInPlace(L, x)) return std::nullopt;
  return VectorXd(x.col(0));
}

std::optional<MatrixXd> Information::covariance(Name name) const {
  const auto inverse = invertPositiveDefinite(H_);
  if (!inverse) return std::nullopt;
  const std::vector<Index> at = findIndices(*this, {name});
  return part(*inverse, at, at);
}

bool isApprox(const Information& a, const Information& b, double tolerance) {
  const auto same = [](const Information::Block& x, const Information::Block& y) {
    return x.name == y.name && x.size == y.size;
  };
  if (!std::equal(a.blocks().begin(), a.blocks().end(), b.blocks().begin(), b.blocks().end(), same)) return false;
  return ((a.H() - b.H()).array().abs() <= tolerance).all() && ((a.b() - b.b()).array().abs() <= tolerance).all();
}

std::ostream& operator<<(std::ostream& out, const Information& value) {
  out << "information over";
  for (const auto& block : value.blocks()) out << " " << block.name << "(" << block.size << ")";
  return out << ":\nH =\n" << value.H() << "\nb = " << value.b().transpose();
}

}  // namespace urban_nav_core
