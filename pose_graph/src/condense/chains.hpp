// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// One step along a chain: over an edge, forward or backward, to a pose.
struct Link {
  int edge = 0;
  bool against = false;  ///< the edge measures the begin of the step in the frame of its end
  int pose = 0;          ///< end of the step
};

/// Partition of a pose graph into a core and chains. Odometry of 50 000 poses with 300 closures has a core of about 600
/// poses, the ends of closures.
struct Chains {
  /// Links first[s]...first[s + 1] - 1 of `links` lead from core pose begin[s] over poses without other edges to the
  /// core pose at the end of the last link.
  std::vector<int> begin;
  std::vector<int> first = {0};
  std::vector<Link> links;
  /// Steps to poses in trees attached by single edges, ordered so that `from` is placed before `link.pose`.
  struct Twig {
    int from = 0;
    Link link;
  };
  std::vector<Twig> twigs;
  std::vector<int> core;        ///< ascending; at least one pose of each component, and all fixed ones
  std::vector<int> core_edges;  ///< edges between core poses that belong to no chain, in order

  std::size_t size() const { return begin.size(); }
  int end(std::size_t s) const { return links[static_cast<std::size_t>(first[s + 1]) - 1].pose; }
};

/// `invertible`: by edge, whether its information is invertible; chains contain only such edges.
template <int D>
Chains findChains(const Problem<D>& problem, const std::vector<char>& invertible);

}  // namespace pose_graph
