// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// What is thought of the edges, and where they put the poses.
template <int D>
struct Judgement {
  std::vector<EdgeAssessment> edges;  ///< chi2 of candidates alone
  std::vector<Rigid<D>> poses;
  double variance = 1.0;
  bool is_too_dense = false;  ///< given up: AdmissionState::is_too_dense
};

/// Admits closures by evidence, with the information taken as it is stated (relaxRobust()), over the reduced graph
/// where that pays. Gives up where what is accepted takes more than `most_work` (AcceptedGraph::work()) to factor.
template <int D>
Judgement<D> judgeGraph(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                        double most_work = std::numeric_limits<double>::infinity());

/// Rejects the closures of all poses but those that stay as they are: odometry alone. Those that fitted what was
/// accepted are undecided.
template <int D>
void rejectCandidates(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& stays,
                      std::vector<EdgeAssessment>& edges) {
  using urban_nav_core::ClosureVerdict;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (stays[static_cast<std::size_t>(problem.edges[e].from)]) continue;
    const bool is_closure = roles[e] == EdgeRole::Candidate;
    edges[e].weight = is_closure ? 0.0 : 1.0;
    edges[e].verdict = is_closure ? ClosureVerdict::Rejected : ClosureVerdict::Accepted;
    if (!is_closure) edges[e].reason = Reason::Role;
    else if (edges[e].reason == Reason::Fits) edges[e].reason = Reason::Undecided;
  }
}

/// Relaxes the edges with weight.
template <int D>
RobustSolution<D> solutionFrom(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const SolveOptions& options, Judgement<D> judged);

}  // namespace pose_graph
