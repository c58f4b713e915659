// SPDX-License-Identifier: BSD-3-Clause
#include "robust/copied_poses.hpp"

#include <algorithm>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"

namespace pose_graph {

namespace {

constexpr double kCopied = 1e-4;  // square of a hundredth of a deviation; six printed digits are a few times less

/// Trusted edges by pose.
template <int D>
std::vector<std::vector<const Edge<D>*>> trustedEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  std::vector<std::vector<const Edge<D>*>> edges(problem.poses.size());
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] != EdgeRole::Trusted) continue;
    edges[sz(problem.edges[e].from)].push_back(&problem.edges[e]);
    edges[sz(problem.edges[e].to)].push_back(&problem.edges[e]);
  }
  return edges;
}

/// Squared distance of two poses in deviations of an information.
template <int D>
double squaredDistance(const Rigid<D>& a, const Rigid<D>& b, const TangentMatrix<D>& information) {
  const Rigid<D> difference = a.inverse() * b;
  Tangent<D> d;
  d.template head<D>() = difference.t;
  d.template tail<kRotationSize<D>>() = logRotation(difference.R);
  return d.dot(information * d);
}

}  // namespace

template <int D>
std::vector<int> withoutCopiedPoses(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  if (problem.fixed.size() < 2) return problem.fixed;
  const auto edges = trustedEdges(problem, roles);
  std::vector<Rigid<D>> poses = problem.poses;
  std::vector<char> reached(poses.size(), 0);
  std::vector<int> kept, open;
  for (const int first : problem.fixed) {
    if (reached[sz(first)]) continue;
    reached[sz(first)] = 1;
    kept.push_back(first);
    open.push_back(first);
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      for (const Edge<D>* edge : edges[sz(at)]) {
        const int next = edge->from == at ? edge->to : edge->from;
        if (reached[sz(next)]) continue;
        reached[sz(next)] = 1;
        open.push_back(next);
        const Rigid<D> there = poses[sz(at)] * (edge->from == at ? edge->Z : edge->Z.inverse());
        if (!std::binary_search(problem.fixed.begin(), problem.fixed.end(), next)) poses[sz(next)] = there;
        else if (!(squaredDistance(there, poses[sz(next)], edge->information) < kCopied)) kept.push_back(next);
      }
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

template std::vector<int> withoutCopiedPoses<2>(const Problem<2>&, const std::vector<EdgeRole>&);
template std::vector<int> withoutCopiedPoses<3>(const Problem<3>&, const std::vector<EdgeRole>&);

}  // namespace pose_graph
