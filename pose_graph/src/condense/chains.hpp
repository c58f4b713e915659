// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// One step along a chain: over an edge, as it stands or against it, to a pose.
struct Link {
  int edge = 0;
  bool against = false;  ///< the edge measures the step's begin in the frame of its end
  int pose = 0;          ///< where the step ends
};

/// How a pose graph falls into a small core and what hangs on it. An odometry of 50 000 poses with 300 closures has a
/// core of some 600 poses: their ends.
struct Chains {
  /// Links first[s]...first[s + 1] - 1 of `links` lead from the core pose begin[s] over poses that have no other edge
  /// to the core pose where the last one ends.
  std::vector<int> begin;
  std::vector<int> first = {0};
  std::vector<Link> links;
  /// Steps to poses that hang on by one edge, in an order in which `from` is known before `link.pose`.
  struct Twig {
    int from = 0;
    Link link;
  };
  std::vector<Twig> twigs;
  std::vector<int> core;        ///< poses, ascending; at least one of each component, and all fixed ones
  std::vector<int> core_edges;  ///< edges between core poses, in order, that belong to no chain

  std::size_t size() const { return begin.size(); }
  int end(std::size_t s) const { return links[static_cast<std::size_t>(first[s + 1]) - 1].pose; }
};

/// `invertible`: for each edge whether its information is; a chain has none that is not.
template <int D>
Chains findChains(const Problem<D>& problem, const std::vector<char>& invertible);

}  // namespace pose_graph
