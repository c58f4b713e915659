// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "chain.hpp"
#include "twist.hpp"

namespace pose_graph {

/// Increments of all links, one column each, as in moved().
template <int D>
using Increments = Eigen::Matrix<double, kTangentSize<D>, Eigen::Dynamic>;

/// The state: the links of the chain, and the poses computed from the first one.
template <int D>
struct ChainState {
  std::vector<Rigid<D>> links;  ///< links[i]: T_i_{i+1}
  std::vector<Rigid<D>> poses;
};
template <int D>
ChainState<D> makeState(const std::vector<Rigid<D>>& poses);
/// Moves each link by its column of `step`.
template <int D>
ChainState<D> moved(const ChainState<D>& state, const Increments<D>& step);

template <int D>
double computeCost(const Problem<D>& problem, const ChainState<D>& state);

/// The normal equations of (19) about a state, weighted: (M + H^T W H) dV = b. M is block-diagonal; H is applied as an
/// operator. All operations take O(links + closures).
template <int D>
class LinearSystem {
 public:
  LinearSystem(const Problem<D>& problem, const Chain<D>& chain, const ChainState<D>& state);

  /// A linearised closure: its whitened rows are G (x_to - x_from).
  struct Row {
    int from, to;
    TangentMatrix<D> G;
  };

  int links() const { return static_cast<int>(blocks_.size()); }
  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<TangentMatrix<D>>& blocks() const { return blocks_; }
  /// Returns minus the gradient of half the cost.
  const Increments<D>& b() const { return b_; }
  double cost() const { return cost_; }

  /// Computes x_k of twist.hpp for all poses, x_0 = 0.
  void sweep(const Increments<D>& step, Increments<D>& x) const;
  /// Computes the transposed sweep: the sum of forces over all poses after each link, as forces on the link.
  void sweepBack(const Increments<D>& pull, Increments<D>& force) const;

  /// Computes ((1 + damping) M + H^T W H) step. `scratch`: overwritten, to avoid allocations.
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
