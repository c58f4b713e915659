// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/pattern.hpp"

namespace pose_graph {

/// An order of elimination with little fill: order[k] is the k-th node to be eliminated. Approximate minimum degree
/// (Amestoy, Davis, Duff, ACM TOMS 837, 2004); nested dissection by METIS where the factor of that would be so
/// expensive that looking for a better order pays.
std::vector<int> eliminationOrder(const Adjacency& graph);
/// By minimum degree alone: found soon, and as good where the factor is cheap.
std::vector<int> minimumDegreeOrder(const Adjacency& graph);

/// Parent of each node (named by its place in the order) in the elimination tree, -1 for a root, and the number of rows
/// below the diagonal of its column of the factor (Gilbert, Ng, Peyton 1994).
struct EliminationTree {
  std::vector<int> parent;
  std::vector<int> count;
};
EliminationTree eliminationTree(const Adjacency& graph, const std::vector<int>& order);
/// Multiplications of a factorisation, by blocks: what orders are compared by.
double factorWork(const EliminationTree& tree);

}  // namespace pose_graph
