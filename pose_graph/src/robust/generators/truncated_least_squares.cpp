// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "linear/index.hpp"
#include "robust/generators/admission.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

constexpr double kWideFactor = 64.0;  // factor of the limit: eight standard deviations
// Ratio of successive limits; at 1.6 the graph with the most ambiguous closures (tuc) ends at another solution.
constexpr double kNarrower = 1.25;
constexpr int kLast = 6;  // limit of steps at the final limit

}  // namespace

template <int D>
void readmitByTruncatedSquares(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const ClosureEvaluator<D>& evaluator, double most_work, AdmissionState<D>& state) {
  std::vector<double> limit(1, 0.0);
  for (int dof = 1; dof <= kTangentSize<D>; ++dof)
    limit.push_back(state.variance * urban_nav_core::chiSquareQuantile(1.0 - Thresholds::kChance, dof));
  const auto toSquare = [&](std::size_t e, const std::vector<Rigid<D>>& poses) {
    const WhitenedEdge<D>& edge = evaluator.edge(static_cast<int>(e));
    return whitenedError(edge, poses[sz(edge.from)], poses[sz(edge.to)]).squaredNorm();
  };
  const auto findLimit = [&](std::size_t e) { return limit[sz(evaluator.edge(static_cast<int>(e)).rank)]; };
  const auto truncated = [&](const std::vector<Rigid<D>>& poses) {
    double sum = 0.0;
    for (std::size_t e = 0; e < roles.size(); ++e)
      sum += roles[e] == EdgeRole::Candidate ? std::min(toSquare(e, poses), findLimit(e)) : toSquare(e, poses);
    return sum;
  };

  // Many closures must be rejected and within the wide limit, and remain so as it decreases.
  const auto worthIt = [&](const std::vector<Rigid<D>>& poses, double wide) {
    std::size_t near = 0;
    for (int e : evaluator.candidates()) near += !state.in[sz(e)] && toSquare(sz(e), poses) <= wide * findLimit(sz(e));
    return static_cast<double>(near) > kMany * static_cast<double>(evaluator.candidates().size());
  };
  if (!worthIt(state.poses, kWideFactor)) return;

  std::vector<char> in = state.in;
  std::vector<double> weights(in.size(), 1.0);
  std::vector<Rigid<D>> poses = state.poses;
  AcceptedGraph<D> graph(problem, most_work);
  for (double wide = kWideFactor; wide > 1.0; wide /= kNarrower) {
    if (!worthIt(poses, wide)) return;
    for (int e : evaluator.candidates()) {
      const double share = toSquare(sz(e), poses) / (wide * findLimit(sz(e)));
      in[sz(e)] = share < 1.0;
      weights[sz(e)] = share < 1.0 ? (1.0 - share) * (1.0 - share) : 0.0;  // Beaton, Tukey, Technometrics 1974
    }
    graph.take(in, weights);
    if (graph.isTooDense()) return;
    graph.relax(poses, 1, 0.0, false);
  }
  for (int i = 0; i < kLast; ++i) {
    const std::vector<char> before = in;
    for (int e : evaluator.candidates()) in[sz(e)] = toSquare(sz(e), poses) <= findLimit(sz(e));
    if (i > 0 && in == before) break;
    graph.take(in);
    if (graph.isTooDense()) return;
    graph.relax(poses, 2, 0.0, false);
  }
  // A lower cost may result from rejecting more closures; more must fit as well.
  const auto fitting = [&](const std::vector<Rigid<D>>& at) {
    return std::count_if(evaluator.candidates().begin(), evaluator.candidates().end(),
                         [&](int e) { return toSquare(sz(e), at) <= findLimit(sz(e)); });
  };
  if (!(truncated(poses) < truncated(state.poses)) || fitting(poses) <= fitting(state.poses)) return;
  state.in = std::move(in);
  state.poses = std::move(poses);
  for (int e : evaluator.candidates()) state.evidence.chi2[sz(e)] = toSquare(sz(e), state.poses) / state.variance;
}

template void readmitByTruncatedSquares<2>(const Problem<2>&, const std::vector<EdgeRole>&, const ClosureEvaluator<2>&,
                                           double, AdmissionState<2>&);
template void readmitByTruncatedSquares<3>(const Problem<3>&, const std::vector<EdgeRole>&, const ClosureEvaluator<3>&,
                                           double, AdmissionState<3>&);

}  // namespace pose_graph
