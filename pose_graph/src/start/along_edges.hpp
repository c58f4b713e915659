// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Dead reckoning: fixed poses stay, and the first pose of each component that has none; the others follow edges from
/// neighbour to neighbour, breadth first, edges between consecutive numbers before all others and the other edges of
/// fixed poses last.
template <int D>
std::vector<Rigid<D>> posesAlongEdges(const Problem<D>& problem);
/// The same from all poses that are known (not 0), which stay; a component without one begins at its first pose.
template <int D>
std::vector<Rigid<D>> posesAlongEdges(const Problem<D>& problem, const std::vector<char>& known);

}  // namespace pose_graph
