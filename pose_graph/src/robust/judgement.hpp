// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// What is thought of the edges, and where they put the poses.
template <int D>
struct Judgement {
  std::vector<EdgeAssessment> edges;  ///< chi2 of candidates alone
  std::vector<Rigid<D>> poses;
  double variance = 1.0;
};

/// Admits closures by evidence, with the information taken as it is stated (relaxRobust()), over the reduced graph
/// where that pays.
template <int D>
Judgement<D> judgeGraph(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

/// Relaxes the edges with weight.
template <int D>
RobustSolution<D> solutionFrom(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const SolveOptions& options, Judgement<D> judged);

}  // namespace pose_graph
