// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/graph_file.hpp"

namespace pose_graph {

/// Priors and sightings of landmarks that contradict odometry and each other.
struct FalsePriors {
  std::vector<int> rejected;  ///< indices in FileProblem::problem.edges, ascending
  std::size_t undecided =
      0;  ///< that contradict as well, where more than half of those that could tell do: all are used
};

/// Relaxes odometry with all of them under Cauchy's kernel, its width falling from what all of them fit to one
/// deviation (graduated non-convexity), and finds those whose chi-square over degrees of freedom ends 100 times beyond
/// that of the middle one, or beyond 1 where that is less. Closures take no part: which of them are true is decided
/// with the priors that are left. Of the priors, and of the sightings of one landmark, fewer than half are rejected:
/// where more contradict, nothing tells which are right. The first sighting of a landmark, which defines it, stays.
template <int D>
FalsePriors findFalsePriors(const FileProblem<D>& file);

}  // namespace pose_graph
