// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

namespace urban_nav_core {

/// Gaussian over named blocks in information form: p(x) ~ exp(-x^T H x / 2 + b^T x). H may be singular: unobserved
/// directions have zero information. Intended for prior terms and for tests; estimators work on their own buffers.
/// Newman et al. 2009, section 2.2: marginalisation is the Schur complement, conditioning removes rows and columns.
class Information {
 public:
  using Name = std::int64_t;
  struct Block {
    Name name = 0;
    Eigen::Index size = 0;
  };

  Information() = default;
  /// Creates blocks of zero information. Names must be unique.
  explicit Information(const std::vector<Block>& blocks);

  const std::vector<Block>& blocks() const { return blocks_; }
  const Eigen::MatrixXd& H() const { return H_; }
  const Eigen::VectorXd& b() const { return b_; }
  bool contains(Name name) const;
  /// Returns the index of the block's first row in H and b; the name must exist.
  Eigen::Index offset(Name name) const;
  Eigen::MatrixXd H(Name row, Name column) const;
  Eigen::VectorXd b(Name name) const;

  /// Appends a block of zero information.
  void append(const Block& block);
  /// Adds information on some blocks; H (dense) and b are in the order of `names`.
  void add(const std::vector<Name>& names, const Eigen::MatrixXd& H, const Eigen::VectorXd& b);
  /// Adds another Gaussian; blocks that do not exist yet are appended.
  void add(const Information& other);

  /// Returns the same Gaussian with its blocks reordered; `order` holds each name once.
  Information permuted(const std::vector<Name>& order) const;
  /// Returns the marginal of the remaining blocks. Directions of the removed blocks without information (eigenvalues
  /// below 1e-12 of the largest) do not reduce that of the others. Empty if H is not finite.
  std::optional<Information> marginalised(const std::vector<Name>& removed) const;
  /// Returns the distribution of the other blocks, given the value of this one.
  Information conditioned(Name name, const Eigen::VectorXd& value) const;

  /// Returns the mean; empty if H is not positive definite.
  std::optional<Eigen::VectorXd> mean() const;
  /// Returns the covariance of one block (a block of H^-1); empty if H is not positive definite.
  std::optional<Eigen::MatrixXd> covariance(Name name) const;

 private:
  std::vector<Block> blocks_;
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
};

/// Returns whether both have the same blocks in the same order and all numbers agree within `tolerance`.
bool isApprox(const Information& a, const Information& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const Information& value);

}  // namespace urban_nav_core
