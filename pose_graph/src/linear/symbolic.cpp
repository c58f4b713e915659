// SPDX-License-Identifier: BSD-3-Clause
#include "linear/symbolic.hpp"

#include <algorithm>
#include <cstddef>

#include "linear/ordering.hpp"

namespace pose_graph {

namespace {

using Unsigned = std::size_t;

Unsigned at(int i) { return static_cast<Unsigned>(i); }

// Returns a postorder: children directly before their parents, the deepest subtree last so that a chain is consecutive.
std::vector<int> postorder(const std::vector<int>& parent) {
  const Unsigned n = parent.size();
  std::vector<int> head(n, -1), next(n, -1), stack, order;
  order.reserve(n);
  for (Unsigned i = n; i-- > 0;) {
    if (parent[i] < 0) continue;
    next[i] = head[at(parent[i])];
    head[at(parent[i])] = static_cast<int>(i);
  }
  for (Unsigned root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    stack.push_back(static_cast<int>(root));
    while (!stack.empty()) {
      const int i = stack.back(), child = head[at(i)];
      if (child < 0) {
        order.push_back(i);
        stack.pop_back();
      } else {
        head[at(i)] = next[at(child)];
        stack.push_back(child);
      }
    }
  }
  return order;
}

struct Run {
  int begin, end;  // places
  int rows;        // below the last place
  double zeros;    // explicit zeros of the factor added by merging
};

// Merging pays off if it adds few zeros; smaller supernodes tolerate more. Limits of CHOLMOD (Chen, Davis, Hager,
// Rajamanickam, ACM TOMS 887, 2008, section 3), in nodes of six numbers.
bool worthJoining(const Run& child, const Run& parent, double zeros) {
  const int columns = parent.end - child.begin;
  const double total = 0.5 * columns * (columns + 1.0) + static_cast<double>(columns) * parent.rows;
  const double share = zeros / total;
  if (columns <= 1) return true;
  if (columns <= 3) return share < 0.5;
  if (columns <= 8) return share < 0.1;
  return share < 0.05;
}

std::vector<Run> findRuns(const EliminationTree& tree) {
  std::vector<Run> runs;
  for (Unsigned j = 0; j < tree.parent.size(); ++j) {
    Run run{static_cast<int>(j), static_cast<int>(j) + 1, tree.count[j], 0.0};
    while (!runs.empty()) {
      const Run& last = runs.back();
      const int above = tree.parent[at(last.end - 1)];
      if (above < run.begin || above >= run.end) break;
      // All rows of the child are then columns or rows of the parent.
      const double missing = (run.end - run.begin) + run.rows - last.rows;
      const double zeros = last.zeros + run.zeros + missing * (last.end - last.begin);
      if (!worthJoining(last, run, zeros)) break;
      run = {last.begin, run.end, run.rows, zeros};
      runs.pop_back();
    }
    runs.push_back(run);
  }
  return runs;
}

}  // namespace

Symbolic analyse(const Adjacency& graph) { return analyse(graph, eliminationOrder(graph)); }

Symbolic analyse(const Adjacency& graph, const std::vector<int>& order) {
  const Unsigned n = order.size();
  EliminationTree tree = eliminationTree(graph, order);
  const std::vector<int> post = postorder(tree.parent);
  Symbolic made;
  made.work = factorWork(tree);
  made.node.resize(n);
  made.place.resize(n);
  std::vector<int> renamed(n);
  for (Unsigned k = 0; k < n; ++k) {
    made.node[k] = order[at(post[k])];
    made.place[at(made.node[k])] = static_cast<int>(k);
    renamed[at(post[k])] = static_cast<int>(k);
  }
  EliminationTree posted{std::vector<int>(n), std::vector<int>(n)};
  for (Unsigned k = 0; k < n; ++k) {
    const int above = tree.parent[at(post[k])];
    posted.parent[k] = above < 0 ? -1 : renamed[at(above)];
    posted.count[k] = tree.count[at(post[k])];
  }

  const std::vector<Run> runs = findRuns(posted);
  made.supernode.resize(n);
  for (Unsigned s = 0; s < runs.size(); ++s) {
    made.begin.push_back(runs[s].end);
    for (int k = runs[s].begin; k < runs[s].end; ++k) made.supernode[at(k)] = static_cast<int>(s);
    const int above = posted.parent[at(runs[s].end - 1)];
    made.parent.push_back(above);  // a place, until all supernodes are known
  }
  for (int& above : made.parent) above = above < 0 ? -1 : made.supernode[at(above)];

  std::vector<int> mark(n, -1);
  std::vector<std::vector<int>> children(runs.size());
  for (Unsigned s = 0; s < runs.size(); ++s)
    if (made.parent[s] >= 0) children[at(made.parent[s])].push_back(static_cast<int>(s));
  for (Unsigned s = 0; s < runs.size(); ++s) {
    const Unsigned start = made.rows.size();
    const auto note = [&](int row) {
      if (row < runs[s].end || mark[at(row)] == static_cast<int>(s)) return;
      mark[at(row)] = static_cast<int>(s);
      made.rows.push_back(row);
    };
    for (int k = runs[s].begin; k < runs[s].end; ++k) {
      const Unsigned node = at(made.node[at(k)]);
      for (int e = graph.first[node]; e < graph.first[node + 1]; ++e) note(made.place[at(graph.neighbours[at(e)])]);
    }
    for (const int child : children[s])
      for (int r = made.row_begin[at(child)]; r < made.row_begin[at(child) + 1]; ++r) note(made.rows[at(r)]);
    std::sort(made.rows.begin() + static_cast<std::ptrdiff_t>(start), made.rows.end());
    made.row_begin.push_back(static_cast<int>(made.rows.size()));
  }
  return made;
}

}  // namespace pose_graph
