// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "condense/chain_sum.hpp"
#include "pose_graph/node_index.hpp"

namespace pose_graph {

/// A way along a track between two poses of a core, with the poses in between as they were laid last: `at` from the
/// begin. A single step is no chain.
class IncrementalChain {
 public:
  IncrementalChain() = default;
  /// `at`: T_begin_pose of each link's end; `steps` leads to the first of them.
  IncrementalChain(const ChainStep* steps, const std::vector<Rigid<3>>& at);

  bool empty() const { return links_.empty(); }
  std::size_t size() const { return links_.size(); }
  const Rigid<3>& at(std::size_t link) const { return links_[link].at; }
  const Edge<3>& edge() const { return edge_; }
  /// The farthest pose from the begin, m.
  double reach() const { return reach_; }

  /// In two at the end of a link, laid as they were; this one is then the first part.
  IncrementalChain splitAfter(std::size_t link, const ChainStep* steps);

  /// The square of what the wanted end (T_begin_end) is off the one it was laid to, in standard deviations of the
  /// chain.
  double bend(const Rigid<3>& wanted) const;
  /// Lays the poses so that they fit that end, and sums up anew.
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
