// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/pattern.hpp"

namespace pose_graph {

/// Returns an elimination order with little fill: order[k] is the k-th node to be eliminated. Approximate minimum
/// degree (Amestoy, Davis, Duff, ACM TOMS 837, 2004), or nested dissection by METIS if the factorisation is so
/// expensive that searching for a better order is worthwhile.
std::vector<int> eliminationOrder(const Adjacency& graph);
/// Returns the minimum-degree order: fast to compute, and equally good if the factorisation is cheap.
std::vector<int> minimumDegreeOrder(const Adjacency& graph);

/// Parent of each node (named by its place in the order) in the elimination tree, -1 for a root, and number of rows
/// below the diagonal in its column of the factor (Gilbert, Ng, Peyton 1994).
struct EliminationTree {
  std::vector<int> parent;
  std::vector<int> count;
};
EliminationTree eliminationTree(const Adjacency& graph, const std::vector<int>& order);
/// Returns the block multiplications of a factorisation, the criterion to compare orders.
double factorWork(const EliminationTree& tree);

}  // namespace pose_graph
