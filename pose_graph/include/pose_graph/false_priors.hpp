// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/graph_file.hpp"

namespace pose_graph {

/// Priors and landmark observations that contradict odometry and each other.
struct FalsePriors {
  std::vector<int> rejected;  ///< indices in FileProblem::problem.edges, ascending
  /// Number of contradicting ones that are kept, because more than half of those that could be tested contradict.
  std::size_t undecided = 0;
};

/// Relaxes odometry, priors and landmark observations under Cauchy's kernel, whose width decreases until it is one
/// deviation (graduated non-convexity). Rejects those whose chi-square over degrees of freedom ends above 100 times the
/// larger of their median and 1. Closures are not used: they are selected afterwards with the remaining priors.
/// Of the priors, and of the observations of one landmark, fewer than half are rejected; if more contradict, all are
/// kept. The first observation of a landmark, which defines it, is always kept.
template <int D>
FalsePriors findFalsePriors(const FileProblem<D>& file);

}  // namespace pose_graph
