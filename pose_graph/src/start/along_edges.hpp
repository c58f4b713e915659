// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Dead reckoning. Fixed poses, and the first pose of each component without any, keep their values. The others follow
/// edges from neighbour to neighbour, breadth first: edges between consecutive numbers first, other edges of fixed
/// poses last.
template <int D>
std::vector<Rigid<D>> posesAlongEdges(const Problem<D>& problem);
/// As above, from all poses with nonzero `known`, which keep their values; a component without one begins at its first
/// pose.
template <int D>
std::vector<Rigid<D>> posesAlongEdges(const Problem<D>& problem, const std::vector<char>& known);

}  // namespace pose_graph
