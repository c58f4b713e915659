// SPDX-License-Identifier: BSD-3-Clause
#include "start/along_edges.hpp"

#include <cstdlib>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"

namespace pose_graph {

namespace {

struct Incidence {
  std::vector<int> first, edge;
};

template <int D>
Incidence makeIncidence(const Problem<D>& problem) {
  Incidence made;
  made.first.assign(problem.poses.size() + 1, 0);
  for (const Edge<D>& edge : problem.edges) {
    ++made.first[sz(edge.from) + 1];
    ++made.first[sz(edge.to) + 1];
  }
  for (std::size_t i = 1; i < made.first.size(); ++i) made.first[i] += made.first[i - 1];
  made.edge.resize(sz(made.first.back()));
  std::vector<int> next(made.first.begin(), made.first.end() - 1);
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    made.edge[sz(next[sz(problem.edges[e].from)]++)] = static_cast<int>(e);
    made.edge[sz(next[sz(problem.edges[e].to)]++)] = static_cast<int>(e);
  }
  return made;
}

}  // namespace

template <int D>
std::vector<Rigid<D>> posesAlongEdges(const Problem<D>& problem) {
  return posesAlongEdges(problem, std::vector<char>(problem.poses.size(), 0));
}

template <int D>
std::vector<Rigid<D>> posesAlongEdges(const Problem<D>& problem, const std::vector<char>& known) {
  const Incidence incidence = makeIncidence(problem);
  std::vector<Rigid<D>> poses = problem.poses;
  std::vector<char> reached = known, fixed(problem.poses.size(), 0);
  for (const int pose : problem.fixed) reached[sz(pose)] = fixed[sz(pose)] = 1;
  // Poses whose neighbours are to be visited; chain edges are followed first, depth first.
  std::vector<int> chain, others;
  std::size_t next_other = 0;
  const auto follow = [&](int pose, const Edge<D>& edge) {
    const int other = edge.from == pose ? edge.to : edge.from;
    if (reached[sz(other)]) return;
    poses[sz(other)] =
        edge.from == pose ? edge.predicted(poses[sz(pose)]) : edge.measured(poses[sz(pose)]) * edge.Z.inverse();
    poses[sz(other)].R = renormalised<D>(poses[sz(other)].R);
    reached[sz(other)] = 1;
    chain.push_back(other);
  };
  const auto visit = [&](int pose, bool chain_only) {
    for (int k = incidence.first[sz(pose)]; k < incidence.first[sz(pose) + 1]; ++k) {
      const Edge<D>& edge = problem.edges[sz(incidence.edge[sz(k)])];
      if (chain_only == (std::abs(edge.from - edge.to) == 1)) follow(pose, edge);
    }
  };
  const auto spread = [&] {
    while (!chain.empty() || next_other < others.size()) {
      if (!chain.empty()) {
        const int pose = chain.back();
        chain.pop_back();
        visit(pose, true);
        if (!fixed[sz(pose)]) others.push_back(pose);
      } else {
        visit(others[next_other++], false);
      }
    }
  };
  for (std::size_t i = poses.size(); i-- > 0;)
    if (reached[i]) chain.push_back(static_cast<int>(i));
  spread();
  // Many edges may start at a fixed pose, such as priors at the reference frame: each is followed only to poses not
  // reached before.
  for (const int pose : problem.fixed)
    for (int k = incidence.first[sz(pose)]; k < incidence.first[sz(pose) + 1]; ++k) {
      follow(pose, problem.edges[sz(incidence.edge[sz(k)])]);
      spread();
    }
  for (std::size_t root = 0; root < poses.size(); ++root) {
    if (reached[root]) continue;
    reached[root] = 1;
    chain.push_back(static_cast<int>(root));
    spread();
  }
  return poses;
}

template std::vector<Rigid<2>> posesAlongEdges<2>(const Problem<2>&);
template std::vector<Rigid<3>> posesAlongEdges<3>(const Problem<3>&);
template std::vector<Rigid<2>> posesAlongEdges<2>(const Problem<2>&, const std::vector<char>&);
template std::vector<Rigid<3>> posesAlongEdges<3>(const Problem<3>&, const std::vector<char>&);

}  // namespace pose_graph
