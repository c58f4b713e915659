// SPDX-License-Identifier: BSD-3-Clause
#include "condense/core_graph.hpp"

#include <algorithm>

namespace pose_graph {

namespace {

// Same value as in solve_condensed.cpp.
constexpr double kLeastCoreShare = 0.5;

}  // namespace

template <int D>
std::optional<CoreGraph<D>> CoreGraph<D>::of(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  // An edge with a weight other than one is not part of a chain.
  std::vector<double> weights(roles.size(), 1.0);
  std::size_t asked = 0;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] == EdgeRole::Trusted) continue;
    weights[e] = 0.5;
    ++asked;
  }
  CoreGraph made{Condensed<D>(problem, weights)};
  const Chains& chains = made.condensed_.chains();
  if (static_cast<double>(chains.core.size()) > (1.0 - kLeastCoreShare) * static_cast<double>(problem.poses.size()))
    return std::nullopt;
  made.condensed_.relinearise();
  made.core_ = made.condensed_.core(problem.poses);
  for (const int e : chains.core_edges) made.roles_.push_back(roles[static_cast<std::size_t>(e)]);
  const auto kept =
      std::count_if(made.roles_.begin(), made.roles_.end(), [](EdgeRole role) { return role != EdgeRole::Trusted; });
  if (static_cast<std::size_t>(kept) != asked) return std::nullopt;
  made.roles_.resize(made.core_.edges.size(), EdgeRole::Trusted);
  return made;
}

template <int D>
int CoreGraph<D>::edge(int core_edge) const {
  const std::vector<int>& edges = condensed_.chains().core_edges;
  return core_edge < static_cast<int>(edges.size()) ? edges[static_cast<std::size_t>(core_edge)] : -1;
}

template <int D>
std::vector<Rigid<D>> CoreGraph<D>::expanded(const std::vector<Rigid<D>>& core_poses) {
  condensed_.expand(core_poses);
  return condensed_.assemble(core_poses);
}

template <int D>
void CoreGraph<D>::relinearise() {
  condensed_.relinearise();
  condensed_.renew(core_);
}

template class CoreGraph<2>;
template class CoreGraph<3>;

}  // namespace pose_graph
