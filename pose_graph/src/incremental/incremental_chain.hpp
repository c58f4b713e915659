// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "condense/chain_sum.hpp"
#include "pose_graph/node_index.hpp"

namespace pose_graph {

/// A chain along a track between two nodes of a core graph, with the present poses in between relative to its begin. A
/// single step is not a chain.
class IncrementalChain {
 public:
  IncrementalChain() = default;
  /// `at`: T_begin_pose of each link's end; `steps` points to the first step.
  IncrementalChain(const ChainStep* steps, const std::vector<Rigid<3>>& at);

  bool empty() const { return links_.empty(); }
  std::size_t size() const { return links_.size(); }
  const Rigid<3>& at(std::size_t link) const { return links_[link].at; }
  const Edge<3>& edge() const { return edge_; }
  /// Returns the largest distance of a pose from the begin, m.
  double reach() const { return reach_; }

  /// Splits the chain at the end of a link, keeping the poses. This object becomes the first part; returns the second.
  IncrementalChain splitAfter(std::size_t link, const ChainStep* steps);

  /// Returns the squared distance between the wanted end (T_begin_end) and the present one, in standard deviations of
  /// the chain.
  double bend(const Rigid<3>& wanted) const;
  /// Moves the poses to fit the wanted end, and updates the sums.
  void lay(const Rigid<3>& wanted, const ChainStep* steps);

 private:
  struct Link {
    Rigid<3> at;
    ChainSum<3> sum;
  };
  void sumUp(const ChainStep* steps);

  std::vector<Link> links_;
  ChainSum<3> sum_;
  Edge<3> edge_;
  double reach_ = 0.0;
};

}  // namespace pose_graph
