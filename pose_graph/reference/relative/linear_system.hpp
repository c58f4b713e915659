// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "chain.hpp"
#include "twist.hpp"

namespace pose_graph {

/// Increments of all links, one column each, as boxPlus takes them.
template <int D>
using Increments = Eigen::Matrix<double, kTangentSize<D>, Eigen::Dynamic>;

/// The state: the links of the chain, and the poses that they lead to from the first.
template <int D>
struct ChainState {
  std::vector<Rigid<D>> links;  ///< links[i]: T_i_{i+1}
  std::vector<Rigid<D>> poses;
};
template <int D>
ChainState<D> makeState(const std::vector<Rigid<D>>& poses);
/// Every link moved by its column.
template <int D>
ChainState<D> moved(const ChainState<D>& state, const Increments<D>& step);

template <int D>
double computeCost(const Problem<D>& problem, const ChainState<D>& state);

/// The normal equations of (19) about a state, weighted: (M + H^T W H) dV = b, where M is block-diagonal and H is a
/// rule for products. Everything is O(links + closures).
template <int D>
class LinearSystem {
 public:
  LinearSystem(const Problem<D>& problem, const Chain<D>& chain, const ChainState<D>& state);

  /// A closure as it stands here: its whitened rows are G (x_to - x_from).
  struct Row {
    int from, to;
    TangentMatrix<D> G;
  };

  int links() const { return static_cast<int>(blocks_.size()); }
  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<TangentMatrix<D>>& blocks() const { return blocks_; }
  /// Minus the gradient of half the cost.
  const Increments<D>& b() const { return b_; }
  double cost() const { return cost_; }

  /// x_k of twist.hpp for all poses, x_0 = 0.
  void sweep(const Increments<D>& step, Increments<D>& x) const;
  /// The transposed sweep: the sum over all poses after each link of what pulls at them, as forces on the link.
  void sweepBack(const Increments<D>& pull, Increments<D>& force) const;

  /// ((1 + damping) M + H^T W H) step. `scratch`: overwritten, to save allocations.
  void apply(double damping, const Increments<D>& step, Increments<D>& result, Increments<D>& scratch) const;

  TangentMatrix<D> linkMatrix(int link) const;

 private:
  std::vector<Rigid<D>> poses_;
  std::vector<TangentMatrix<D>> blocks_;
  std::vector<Row> rows_;
  Increments<D> b_;
  double cost_ = 0.0;
};

}  // namespace pose_graph
