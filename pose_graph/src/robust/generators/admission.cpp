// SPDX-License-Identifier: BSD-3-Clause
#include "robust/generators/admission.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "linear/index.hpp"
#include "robust/evidence/variances.hpp"
#include "start/along_edges.hpp"

namespace pose_graph {

namespace {

constexpr int kGrowthRounds = 30;
// Share of the candidates. If fewer are admitted, groups are admitted too. If many are admitted, the graph is still
// changing, and only closures with strong evidence are.
constexpr double kLittle = 0.01;
constexpr std::size_t kGroup = 20;  // a larger group is a path driven twice, not a repeated error

// Returns the groups that are tested for a common bias.
std::vector<int> smallGroups(const std::vector<int>& group) {
  std::map<int, std::size_t> size;
  for (int g : group)
    if (g >= 0) ++size[g];
  std::vector<int> made(group.size(), -1);
  for (std::size_t e = 0; e < group.size(); ++e)
    if (group[e] >= 0 && size[group[e]] > 1 && size[group[e]] <= kGroup) made[e] = group[e];
  return made;
}

}  // namespace

template <int D>
AdmissionState<D> admitClosures(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const ClosureEvaluator<D>& evaluator, const std::vector<int>& group,
                                const Thresholds& thresholds, const InformationScale& scale, double most_work) {
  AdmissionState<D> state;
  for (std::size_t e = 0; e < problem.edges.size(); ++e)
    state.in.push_back(evaluator.edge(static_cast<int>(e)).rank > 0);  // an edge without information connects nothing
  for (int e : evaluator.candidates()) state.in[sz(e)] = 0;
  Problem<D> part = problem.withoutEdges();
  bool asserted = false;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    if (state.in[e] && roles[e] == EdgeRole::Trusted) part.edges.push_back(problem.edges[e]);
    asserted |= roles[e] == EdgeRole::Asserted;
  }
  state.poses = posesAlongEdges(part);
  AcceptedGraph<D> graph(problem, most_work);
  graph.take(state.in);
  graph.relax(state.poses, kRoundSteps, kRoundShare, asserted);
  const std::vector<int> small = smallGroups(group);
  std::vector<int> expelled(problem.edges.size(), 0);
  std::set<int> tried;
  bool all = false;
  const double candidates = static_cast<double>(evaluator.candidates().size());
  const auto isFew = [&](std::size_t changes) {
    return static_cast<double>(changes) <= Thresholds::kNegligible * candidates;
  };
  for (int round = 0; round < kGrowthRounds; ++round) {
    state.variance = varianceFactor(evaluator, state.in, state.poses, graph.unknowns(), thresholds, scale.factor);
    state.evidence = evaluator.evaluate(graph, state.in, state.poses, state.variance, small, kUncontrolled);
    if (!state.evidence.known) break;
    if (round == 0) all = admitAll(evaluator, group, small, thresholds, scale, graph, state);
    AdmissionRound<D> now(evaluator, group, thresholds, state.evidence, state.in);
    now.expel(expelled);
    now.admit(expelled, thresholds.early_evidence);
    const auto much = [&] { return static_cast<double>(now.admitted) > kMany * candidates; };
    if (!much()) now.admit(expelled, Thresholds::kEvidence);
    if (static_cast<double>(now.admitted) < kLittle * candidates) {
      now.admitGroups(expelled);
      now.join(graph, expelled);
    }
    const bool few = isFew(now.changes);
    if (now.changes > 0) {
      state.in = std::move(now.next);
      graph.take(state.in);
      state.is_too_dense = graph.isTooDense();
      if (state.is_too_dense) break;
      graph.relax(state.poses, kRoundSteps, kRoundShare, now.joined || much() || round < 5);
    }
    if (!few || now.joined || admitOneGroup(evaluator, group, thresholds, tried, graph, state)) continue;
    if (all && std::count(state.in.begin(), state.in.end(), 0) == 0) break;
    // If a round makes so few changes that it would be the last one, the changes are decided at the converged solution.
    std::size_t changes = 0;
    do {
      changes = validateFinally(evaluator, group, small, thresholds, scale, expelled, graph, state);
    } while (changes > 0 && isFew(changes) && ++round < kGrowthRounds);
    if (changes == 0) break;
  }
  return state;
}

namespace {

constexpr std::size_t kFew = 20;  // limit of closures admitted at once
constexpr int kExpelled = 2;      // removals after which an edge is not readmitted

}  // namespace

template <int D>
bool AdmissionRound<D>::excused(int e, double off) const {
  return off * asStated() <= sampledMargin() * limit(e) && evidence_.likelier[sz(e)] >= Thresholds::kEvidence &&
         (evidence_.group_chi2[sz(e)] <= sampledMargin() * thresholds_.limit.back() ||
          evidence_.group_likelier[sz(e)] >= Thresholds::kEvidence);
}

template <int D>
void AdmissionRound<D>::let(int e) {
  next[sz(e)] = 1;
  ++changes;
  ++admitted;
}

template <int D>
void AdmissionRound<D>::expel(std::vector<int>& times) {
  const auto measureOff = [&](int e) { return std::max(evidence_.chi2[sz(e)], evidence_.group_chi2[sz(e)]); };
  double worst = 0.0;
  for (int e : evaluator_.candidates())
    if (in_[sz(e)]) worst = std::max(worst, measureOff(e));
  for (int e : evaluator_.candidates()) {
    if (!in_[sz(e)] || measureOff(e) <= leavesBeyond(thresholds_, limit(e), worst) || excused(e, measureOff(e)))
      continue;
    next[sz(e)] = 0;
    ++times[sz(e)];
    ++changes;
  }
}

template <int D>
void AdmissionRound<D>::admit(const std::vector<int>& times, double least) {
  std::vector<double> evidence;
  std::size_t inside = 0;
  for (int e : evaluator_.candidates()) {
    inside += in_[sz(e)] ? 1 : 0;
    if (outAndFits(e) && evidence_.likelier[sz(e)] >= least) evidence.push_back(evidence_.likelier[sz(e)]);
  }
  if (evidence.size() >= kFew && evidence.size() > inside) {
    const auto half = evidence.begin() + static_cast<std::ptrdiff_t>(evidence.size() / 2);
    std::nth_element(evidence.begin(), half, evidence.end());
    least = *half;
  }
  for (int e : evaluator_.candidates())
    if (!next[sz(e)] && outAndFits(e) && evidence_.likelier[sz(e)] >= least && times[sz(e)] < kExpelled) let(e);
}

template <int D>
void AdmissionRound<D>::admitLikely(const std::vector<int>& times) {
  double inside = 1.0, outside = 1.0;
  for (int e : evaluator_.candidates()) ++(in_[sz(e)] ? inside : outside);
  const double likely = Thresholds::kEvidence - std::max(0.0, std::log(inside / outside));
  for (int e : evaluator_.candidates()) {
    if (!outAndFits(e) || times[sz(e)] >= kExpelled) continue;
    // Only for closures that would not be removed if they were inside: with low information, false closures reach the
    // lower evidence as well.
    const double least = evidence_.chi2[sz(e)] <= sampledMargin() * limit(e) ? likely : Thresholds::kEvidence;
    if (evidence_.likelier[sz(e)] >= least) let(e);
  }
}

template <int D>
void AdmissionRound<D>::admitGroups(const std::vector<int>& times) {
  std::map<int, std::vector<double>> chi2;
  for (int e : evaluator_.candidates())
    if (!in_[sz(e)] && !next[sz(e)] && times[sz(e)] < kExpelled && std::isfinite(evidence_.chi2[sz(e)]))
      chi2[group_[sz(e)]].push_back(evidence_.chi2[sz(e)]);
  std::set<int> fitting;
  std::size_t largest = 0;
  for (auto& [name, values] : chi2) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() < 2 || *middle > thresholds_.limit.back()) continue;
    fitting.insert(name);
    largest = std::max(largest, values.size());
  }
  for (int e : evaluator_.candidates()) {
    const int name = group_[sz(e)];
    if (next[sz(e)] || times[sz(e)] >= kExpelled || !fitting.count(name) || 2 * chi2[name].size() < largest) continue;
    if (outAndFits(e)) let(e);
  }
}

template <int D>
void AdmissionRound<D>::join(const AcceptedGraph<D>& graph, const std::vector<int>& times) {
  std::map<std::pair<int, int>, std::map<int, std::vector<int>>> between;
  for (int e : evaluator_.candidates()) {
    if (in_[sz(e)] || times[sz(e)] >= kExpelled) continue;
    const int a = graph.component(evaluator_.edge(e).from), b = graph.component(evaluator_.edge(e).to);
    if (a != b) between[{std::min(a, b), std::max(a, b)}][group_[sz(e)]].push_back(e);
  }
  for (const auto& [parts, groups] : between) {
    const std::vector<int>* best = nullptr;
    for (const auto& [name, members] : groups)
      if (members.size() > 1 && (!best || members.size() > best->size())) best = &members;
    if (!best) continue;
    for (int e : *best) let(e);
    joined = true;
  }
}

namespace {

// A trial with all candidates takes as long as a graph without false closures, and much longer if false closures
// between arbitrary places make the factor dense. It is made if odometry contradicts almost none of them and one by
// chance, or if this share of the loops of near closures closes, provided that all take at most kWork times the work of
// the mutually confirmed ones. If the trial is cheap, limited by this number of block multiplications per pose and
// edge, it is always made: over a long path the covariance of odometry is that of a straight line while its errors lie
// on an arc, so that true closures are contradicted too.
constexpr double kClosing = 0.97, kCheap = 30.0;
// Share of closing loops below which false closures exist, given enough loops, regardless of odometry.
constexpr double kOpen = 0.9;
// Limit of the total squared residuals relative to the assumed variance; with at least kFewNumbers degrees of freedom
// chance no longer explains an excess.
constexpr double kBentFactor = 1.5, kFewNumbers = 60.0;

}  // namespace

template <int D>
bool admitAll(const ClosureEvaluator<D>& evaluator, const std::vector<int>& group, const std::vector<int>& small_group,
              const Thresholds& thresholds, const InformationScale& scale, AcceptedGraph<D>& graph,
              AdmissionState<D>& state) {
  const auto limit = [&](int e) { return findLimit(thresholds, evaluator.edge(e)); };
  const double candidates = static_cast<double>(evaluator.candidates().size());
  const auto joins = [&](int e) {
    return !std::isfinite(state.evidence.chi2[sz(e)]);
  };  // joins two parts: not tested here
  AdmissionState<D> all = state;
  for (int e : evaluator.candidates()) all.in[sz(e)] = evaluator.edge(e).rank > 0 && !joins(e);
  // A better order is not worth computing for a cheap factorisation.
  if (graph.work(all.in, true) > kCheap * static_cast<double>(state.poses.size() + state.in.size())) {
    double contradicted = 0.0;
    for (int e : evaluator.candidates()) contradicted += !joins(e) && state.evidence.chi2[sz(e)] > limit(e);
    const bool many_open = scale.true_loops >= kTellingLoops && scale.true_share < kOpen;
    if (many_open || (contradicted > 1.0 + Thresholds::kNegligible * candidates && scale.true_share < kClosing))
      return false;
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

  // Among many true closures another one is likely, hence less evidence is needed.
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
  // Many false closures that bend the graph slightly fit individually, but not together.
  double redundancy = -static_cast<double>(graph.unknowns()) * kTangentSize<D>;
  for (std::size_t e = 0; e < all.in.size(); ++e)
    redundancy += all.in[e] ? evaluator.edge(static_cast<int>(e)).rank : 0;
  const bool bent = graph.cost(all.poses) > kBentFactor * all.variance * std::max(redundancy, kFewNumbers);
  if (!all.evidence.known || bent || poor > Thresholds::kContested * candidates) {
    graph.take(state.in);
    return false;
  }
  state = std::move(all);
  return true;
}

template AdmissionState<2> admitClosures<2>(const Problem<2>&, const std::vector<EdgeRole>&, const ClosureEvaluator<2>&,
                                            const std::vector<int>&, const Thresholds&, const InformationScale&,
                                            double);
template AdmissionState<3> admitClosures<3>(const Problem<3>&, const std::vector<EdgeRole>&, const ClosureEvaluator<3>&,
                                            const std::vector<int>&, const Thresholds&, const InformationScale&,
                                            double);
template class AdmissionRound<2>;
template class AdmissionRound<3>;
template bool admitAll<2>(const ClosureEvaluator<2>&, const std::vector<int>&, const std::vector<int>&,
                          const Thresholds&, const InformationScale&, AcceptedGraph<2>&, AdmissionState<2>&);
template bool admitAll<3>(const ClosureEvaluator<3>&, const std::vector<int>&, const std::vector<int>&,
                          const Thresholds&, const InformationScale&, AcceptedGraph<3>&, AdmissionState<3>&);

}  // namespace pose_graph
