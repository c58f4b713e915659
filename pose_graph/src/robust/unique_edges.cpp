// SPDX-License-Identifier: BSD-3-Clause
#include "robust/unique_edges.hpp"

#include <cstdint>
#include <unordered_map>
#include <utility>

#include "linear/index.hpp"

namespace pose_graph {

template <int D>
UniqueEdges<D> uniqueEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  UniqueEdges<D> made;
  made.problem = problem.withoutEdges();
  std::unordered_map<std::uint64_t, int> latest;  // between two poses, and for each the one before
  std::vector<int> before;
  latest.reserve(roles.size());
  for (std::size_t e = 0; e < roles.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    int& last = latest.emplace(std::uint64_t{sz(edge.from)} << 32 | sz(edge.to), -1).first->second;
    int same = last;
    for (; same >= 0; same = before[sz(same)]) {
      const Edge<D>& other = made.problem.edges[sz(same)];
      if (other.Z.t == edge.Z.t && other.Z.R == edge.Z.R && other.information == edge.information &&
          other.lever == edge.lever)
        break;
    }
    if (same >= 0) {
      made.of_edge.push_back(same);
      if (roles[e] != EdgeRole::Candidate) made.roles[sz(same)] = roles[e];
      continue;
    }
    before.push_back(std::exchange(last, static_cast<int>(made.problem.edges.size())));
    made.of_edge.push_back(last);
    made.problem.edges.push_back(edge);
    made.roles.push_back(roles[e]);
  }
  return made;
}

template UniqueEdges<2> uniqueEdges<2>(const Problem<2>&, const std::vector<EdgeRole>&);
template UniqueEdges<3> uniqueEdges<3>(const Problem<3>&, const std::vector<EdgeRole>&);

}  // namespace pose_graph
