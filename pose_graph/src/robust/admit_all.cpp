// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "linear/index.hpp"
#include "robust/admission.hpp"
#include "robust/admission_thresholds.hpp"
#include "robust/variance_factor.hpp"

namespace pose_graph {

namespace {

// Trying costs what a graph without false closures costs, and far more where false ones between any places make the
// factor dense. It is tried where odometry contradicts no more than this share of them and one by chance, or so many
// loops of near closures close, if all take at most kWork times the work of those that another one confirms. Where
// trying is cheap, at most so many multiplications of blocks a pose and an edge, it is tried anyway: over a long way
// odometry's covariance is that of a straight line while its errors lie on an arc, so that true ones are contradicted
// too.
constexpr double kContradicted = 1e-3, kClosing = 0.97, kCheap = 30.0;
// Where so many loops are known to close and this share of all does not, there are false ones, whatever odometry says.
constexpr double kTelling = 30.0, kOpen = 0.9;
// Baarda's test finds single outliers among many right ones. Beyond this share it starts from the wrong side.
constexpr double kPoor = 0.02;
// Of what the residuals may be together, times the assumed variance; from so many numbers on that is a matter
// of chance no more.
constexpr double kBentFactor = 1.5, kFewNumbers = 60.0;

}  // namespace

template <int D>
bool admitAll(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const std::vector<int>& small_group,
              const Thresholds& thresholds, const InformationScale& scale, AcceptedGraph<D>& graph,
              AdmissionState<D>& state) {
  const auto limit = [&](int e) { return findLimit(thresholds, evaluator.edge(e)); };
  const double candidates = static_cast<double>(evaluator.candidates().size());
  const auto joins = [&](int e) { return !std::isfinite(state.evidence.chi2[sz(e)]); };  // two parts: not by itself
  AdmissionState<D> all = state;
  for (int e : evaluator.candidates()) all.in[sz(e)] = evaluator.edge(e).rank > 0 && !joins(e);
  // Who looks for a better order of something cheap finds none.
  if (graph.work(all.in, true) > kCheap * static_cast<double>(state.poses.size() + state.in.size())) {
    double contradicted = 0.0;
    for (int e : evaluator.candidates()) contradicted += !joins(e) && state.evidence.chi2[sz(e)] > limit(e);
    const bool many_open = scale.true_loops >= kTelling && scale.true_share < kOpen;
    if (many_open || (contradicted > 1.0 + kContradicted * candidates && scale.true_share < kClosing)) return false;
    std::vector<int> members(state.in.size(), 0);
    for (int e : evaluator.candidates()) ++members[sz(group[sz(e)])];
    std::vector<char> confirmed = state.in;
    for (int e : evaluator.candidates()) confirmed[sz(e)] = all.in[sz(e)] && members[sz(group[sz(e)])] > 1;
    if (graph.work(all.in) > kWork * graph.work(confirmed)) return false;
  }

  graph.take(all.in);
  if (graph.isTooDense()) {
    graph.take(state.in);
    return false;
  }
  graph.relax(all.poses, kRoundSteps, kRoundShare, true);
  all.variance = varianceFactor(evaluator, all.in, all.poses, graph.unknowns(), thresholds, scale.factor);
  all.evidence = evaluator.evaluate(graph, all.in, all.poses, all.variance, small_group, kUncontrolled);

  // Among many that are right one more is likely to be, so that less evidence is needed.
  double contradicted = 0.0, confident = 0.0, poor = 0.0;
  const auto contradicts = [&](int e) {
    return !(all.evidence.chi2[sz(e)] <= limit(e)) || all.evidence.group_chi2[sz(e)] > thresholds.limit.back();
  };
  for (int e : evaluator.candidates()) {
    if (!all.in[sz(e)]) continue;
    contradicted += contradicts(e);
    confident += !contradicts(e) && all.evidence.likelier[sz(e)] >= Thresholds::kEvidence;
  }
  const double enough = Thresholds::kEvidence - std::max(0.0, std::log((confident + 1.0) / (contradicted + 1.0)));
  for (int e : evaluator.candidates())
    poor += all.in[sz(e)] && (contradicts(e) || !(all.evidence.likelier[sz(e)] >= enough));
  // Many false ones that bend the graph a little each fit one by one, but not all together.
  double redundancy = -static_cast<double>(graph.unknowns()) * kTangentSize<D>;
  for (std::size_t e = 0; e < all.in.size(); ++e)
    redundancy += all.in[e] ? evaluator.edge(static_cast<int>(e)).rank : 0;
  const bool bent = graph.cost(all.poses) > kBentFactor * all.variance * std::max(redundancy, kFewNumbers);
  if (!all.evidence.known || bent || poor > kPoor * candidates) {
    graph.take(state.in);
    return false;
  }
  state = std::move(all);
  return true;
}

template bool admitAll<2>(const ClosureEvaluator<2>&, const std::vector<int>&, const std::vector<int>&,
                          const Thresholds&, const InformationScale&, AcceptedGraph<2>&, AdmissionState<2>&);
template bool admitAll<3>(const ClosureEvaluator<3>&, const std::vector<int>&, const std::vector<int>&,
                          const Thresholds&, const InformationScale&, AcceptedGraph<3>&, AdmissionState<3>&);

}  // namespace pose_graph
