// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

namespace urban_nav_core {

/// A Gaussian over named blocks, as information: p(x) ~ exp(-x^T H x / 2 + b^T x). H may be singular: directions of
/// which nothing is known have zero information. Meant for prior terms and for checks; the fast path of an estimator
/// works on its own buffers. Newman et al. 2009, section 2.2: marginalising is the Schur complement, conditioning takes
/// rows away.
class Information {
 public:
  using Name = std::int64_t;
  struct Block {
    Name name = 0;
    Eigen::Index size = 0;
  };

  Information() = default;
  /// Blocks of zero information. Names must differ.
  explicit Information(const std::vector<Block>& blocks);

  const std::vector<Block>& blocks() const { return blocks_; }
  const Eigen::MatrixXd& H() const { return H_; }
  const Eigen::VectorXd& b() const { return b_; }
  bool contains(Name name) const;
  /// Where the block begins in H and b; the name must be known.
  Eigen::Index offset(Name name) const;
  Eigen::MatrixXd H(Name row, Name column) const;
  Eigen::VectorXd b(Name name) const;

  /// A further block at the end, of zero information.
  void append(const Block& block);
  /// Adds the information of some blocks, in the order of `names`: H is theirs, dense, b likewise.
  void add(const std::vector<Name>& names, const Eigen::MatrixXd& H, const Eigen::VectorXd& b);
  /// Adds another Gaussian; blocks that are new are appended.
  void add(const Information& other);

  /// The same Gaussian with its blocks in another order; `order` holds each name once.
  Information permuted(const std::vector<Name>& order) const;
  /// The marginal of the other blocks. Directions of the removed blocks without information (eigenvalues below 1e-12 of
  /// the largest) take nothing away. Empty where H is not finite.
  std::optional<Information> marginalised(const std::vector<Name>& removed) const;
  /// The others given that this block has this value.
  Information conditioned(Name name, const Eigen::VectorXd& value) const;

  /// The mean, empty where H is not positive definite.
  std::optional<Eigen::VectorXd> mean() const;
  /// The covariance of one block (a block of H^-1); empty where H is not positive definite.
  std::optional<Eigen::MatrixXd> covariance(Name name) const;

 private:
  std::vector<Block> blocks_;
  Eigen::MatrixXd H_;
  Eigen::VectorXd b_;
};

/// Same blocks in the same order, and every number within `tolerance`.
bool isApprox(const Information& a, const Information& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const Information& value);

}  // namespace urban_nav_core
