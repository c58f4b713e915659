// SPDX-License-Identifier: BSD-3-Clause
#include "robust/selection.hpp"

#include <utility>

#include "robust/judgement.hpp"
#include "robust/unique_edges.hpp"

namespace pose_graph {

template <int D>
RobustSolution<D> relaxSelected(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const SolveOptions& options) {
  const UniqueEdges<D> unique = uniqueEdges(problem, roles);
  Selection<D> selection(unique.problem, unique.roles);
  selection.run();
  SelectionReport report;
  report.unweighed = selection.isUnweighed();
  VarianceFactors factors;
  if (selection.wasJudged()) {
    report.contested = selection.wasContested();
    report.log_evidence = selection.evidence();
    report.undecided = selection.isUndecided();
    report.has_rival = !report.undecided && selection.keepShared();
    if (selection.hasVariances()) factors = selection.hypothesis().factors;
    report.odometry_factor = factors.odometry;
    report.closure_factor = factors.closures;
    report.rescaled = !report.undecided && !report.has_rival && selection.isRescaled();
  }
  const std::vector<char> stays = report.undecided ? selection.inUncontestedParts() : std::vector<char>();
  const bool takes_unopposed = selection.unopposed() && (report.undecided || selection.rejectsAny());
  Judgement<D> chosen = takes_unopposed ? *selection.unopposed() : selection.take();
  if (report.undecided || takes_unopposed) {
    factors = {};
    report.odometry_factor = report.closure_factor = 1.0;
    report.rescaled = false;
  }
  if (takes_unopposed) {
    report.has_rival = selection.isThinlyJoined();
    report.undecided = false;
  } else if (report.undecided) {
    for (std::size_t i = 0; i < stays.size(); ++i)
      if (!stays[i]) chosen.poses[i] = selection.odometryAlone().poses[i];
    for (const int pose : problem.fixed) chosen.poses[sz(pose)] = problem.poses[sz(pose)];
    rejectCandidates(unique.problem, unique.roles, stays, chosen.edges);
  }
  Judgement<D> all;
  all.poses = std::move(chosen.poses);
  all.variance = chosen.variance;
  for (const int e : unique.of_edge) all.edges.push_back(chosen.edges[sz(e)]);
  RobustSolution<D> made = report.rescaled
                               ? solutionFrom(withFactors(problem, roles, factors), roles, options, std::move(all))
                               : solutionFrom(problem, roles, options, std::move(all));
  made.selection = report;
  return made;
}

template RobustSolution<2> relaxSelected<2>(const Problem<2>&, const std::vector<EdgeRole>&, const SolveOptions&);
template RobustSolution<3> relaxSelected<3>(const Problem<3>&, const std::vector<EdgeRole>&, const SolveOptions&);

}  // namespace pose_graph
