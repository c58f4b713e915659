// SPDX-License-Identifier: BSD-3-Clause
#include "linear/ordering.hpp"

#include <suitesparse/amd.h>
#include <suitesparse/cholmod.h>

#include <cassert>
#include <cstddef>
#include <memory>
#include <numeric>

namespace pose_graph {

namespace {

std::vector<int> byNestedDissection(const Adjacency& graph) {
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  std::vector<int> rows;
  // CHOLMOD requires one triangle of a symmetric pattern.
  cholmod_sparse A{};
  std::vector<int> starts = {0};
  for (int j = 0; j < graph.size(); ++j) {
    for (int k = graph.first[static_cast<std::size_t>(j)]; k < graph.first[static_cast<std::size_t>(j) + 1]; ++k)
      if (graph.neighbours[static_cast<std::size_t>(k)] < j)
        rows.push_back(graph.neighbours[static_cast<std::size_t>(k)]);
    starts.push_back(static_cast<int>(rows.size()));
  }
  A.nrow = A.ncol = static_cast<std::size_t>(graph.size());
  A.nzmax = rows.size();
  A.p = starts.data();
  A.i = rows.data();
  A.stype = 1;
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_PATTERN;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = 1;
  A.packed = 1;
  std::vector<int> order(static_cast<std::size_t>(graph.size()));
  const bool done = cholmod_metis(&A, nullptr, 0, 0, order.data(), &common) != 0;
  cholmod_finish(&common);
  return done ? order : std::vector<int>();
}

// Work per node above which nested dissection is tried. It takes some microseconds per node, a 6x6 block multiplication
// less than a tenth of one, so an order with half the multiplications pays off within one factorisation.
constexpr double kWorkWorthDissecting = 400.0;

}  // namespace

double factorWork(const EliminationTree& tree) {
  return std::accumulate(tree.count.begin(), tree.count.end(), 0.0,
                         [](double sum, int count) { return sum + (count + 1.0) * (count + 1.0); });
}

std::vector<int> minimumDegreeOrder(const Adjacency& graph) {
  if (graph.size() == 0) return {};
  std::vector<int> order(static_cast<std::size_t>(graph.size()));
  double control[AMD_CONTROL];
  amd_defaults(control);
  control[AMD_AGGRESSIVE] = 1;
  const int status =
      amd_order(graph.size(), graph.first.data(), graph.neighbours.data(), order.data(), control, nullptr);
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED) std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<int> eliminationOrder(const Adjacency& graph) {
  if (graph.size() == 0) return {};
  std::vector<int> order = minimumDegreeOrder(graph);
  const double expected = factorWork(eliminationTree(graph, order));
  if (expected < kWorkWorthDissecting * graph.size()) return order;
  std::vector<int> dissected = byNestedDissection(graph);
  if (!dissected.empty() && factorWork(eliminationTree(graph, dissected)) < expected) return dissected;
  return order;
}

EliminationTree eliminationTree(const Adjacency& graph, const std::vector<int>& order) {
  const std::size_t n = static_cast<std::size_t>(graph.size());
  assert(order.size() == n);
  std::vector<int> place(n);
  for (std::size_t k = 0; k < n; ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  EliminationTree tree{std::vector<int>(n, -1), std::vector<int>(n, 0)};
  std::vector<int> ancestor(n, -1), mark(n, -1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t node = static_cast<std::size_t>(order[k]);
    for (int e = graph.first[node]; e < graph.first[node + 1]; ++e) {
      int i = place[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])];
      while (i != -1 && i < static_cast<int>(k)) {  // up the tree, with path compression
        const int next = ancestor[static_cast<std::size_t>(i)];
        ancestor[static_cast<std::size_t>(i)] = static_cast<int>(k);
        if (next == -1) tree.parent[static_cast<std::size_t>(i)] = static_cast<int>(k);
        i = next;
      }
    }
  }
  // Row k of the factor is the part of the tree between its entries in A and k.
  for (std::size_t k = 0; k < n; ++k) {
    mark[k] = static_cast<int>(k);
    const std::size_t node = static_cast<std::size_t>(order[k]);
    for (int e = graph.first[node]; e < graph.first[node + 1]; ++e) {
      int i = place[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)])];
      if (i > static_cast<int>(k)) continue;
      for (; mark[static_cast<std::size_t>(i)] != static_cast<int>(k); i = tree.parent[static_cast<std::size_t>(i)]) {
        ++tree.count[static_cast<std::size_t>(i)];
        mark[static_cast<std::size_t>(i)] = static_cast<int>(k);
      }
    }
  }
  return tree;
}

}  // namespace pose_graph
