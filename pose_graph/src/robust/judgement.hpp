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

/// Rejects all closures: odometry alone. Those that fitted what was accepted are undecided.
inline void rejectCandidates(const std::vector<EdgeRole>& roles, std::vector<EdgeAssessment>& edges) {
  for (std::size_t e = 0; e < roles.size(); ++e) {
    const bool is_closure = roles[e] == EdgeRole::Candidate;
    edges[e].weight = is_closure ? 0.0 : 1.0;
    edges[e].verdict = is_closure ? urban_nav_core::ClosureVerdict::Rejected : urban_nav_core::ClosureVerdict::Accepted;
    if (!is_closure) edges[e].reason = Reason::Role;
    else if (edges[e].reason == Reason::Fits) edges[e].reason = Reason::Undecided;
  }
}

/// Relaxes the edges with weight.
template <int D>
RobustSolution<D> solutionFrom(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const SolveOptions& options, Judgement<D> judged);

}  // namespace pose_graph
