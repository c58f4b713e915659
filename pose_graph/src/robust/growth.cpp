// SPDX-License-Identifier: BSD-3-Clause
#include "robust/growth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "start/along_edges.hpp"

namespace pose_graph {

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

// Loops of near closures (information_scale.hpp) may hide what only long ways show: twice their deviations are allowed for
// until there are closures to tell. 1 loses more true ones (manhattan: 25 of 1954 for 12), 2 does as well.
constexpr double kCaution = 4.0;
constexpr double kPriorTangents = 10.0;
constexpr int kRounds = 30;
constexpr int kSteps = 8;
constexpr double kShare = 0.01;     // a round's relaxation: residuals then move by less than a tenth of their noise
constexpr std::size_t kFew = 20;    // so many enter at once
constexpr double kSettled = 1e-3;   // of the candidates: when fewer change, it is done
constexpr std::size_t kGroup = 20;  // larger groups are no repeated mistake but a way travelled twice
// A chi-square from 24 samples is good to 0.29 of its value: what leaves is off by two deviations of that.
constexpr double kDoubt = 1.58;
constexpr int kExpelled = 2;  // times out: stays out

// Groups worth a test for a common bias.
std::vector<int> smallGroups(const std::vector<int>& group) {
  std::map<int, std::size_t> size;
  for (int g : group)
    if (g >= 0) ++size[g];
  std::vector<int> made(group.size(), -1);
  for (std::size_t e = 0; e < group.size(); ++e)
    if (group[e] >= 0 && size[group[e]] > 1 && size[group[e]] <= kGroup) made[e] = group[e];
  return made;
}

// A round of growing: what enters and what leaves.
template <int D>
class Round {
 public:
  Round(const Witness<D>& witness, const std::vector<int>& group, const Thresholds& thresholds,
        const Evidence& evidence, const std::vector<char>& in)
      : witness_(witness), group_(group), thresholds_(thresholds), evidence_(evidence), in_(in), next(in) {}

  // In, and more than chance can explain; far off ones first, as they spoil the others.
  void expel(std::vector<int>& times) {
    double worst = 0.0;
    for (int e : witness_.candidates())
      if (in_[sz(e)]) worst = std::max({worst, evidence_.chi2[sz(e)], evidence_.group_chi2[sz(e)]});
    const double tangent = thresholds_.limit.back();
    for (int e : witness_.candidates()) {
      if (!in_[sz(e)]) continue;
      const double off = std::max(evidence_.chi2[sz(e)], evidence_.group_chi2[sz(e)]);
      if (off <= std::max(kDoubt * limit(e), std::sqrt(tangent * worst))) continue;
      next[sz(e)] = 0;
      ++times[sz(e)];
      ++changes;
    }
  }

  // Out, fits, and has evidence: the better half, or all once they are fewer than those inside.
  void admit(const std::vector<int>& times, double least) {
    std::vector<double> evidence;
    std::size_t inside = 0;
    for (int e : witness_.candidates()) {
      inside += in_[sz(e)] ? 1 : 0;
      if (outAndFits(e) && evidence_.likelier[sz(e)] >= least) evidence.push_back(evidence_.likelier[sz(e)]);
    }
    if (evidence.size() >= kFew && evidence.size() > inside) {
      const auto half = evidence.begin() + static_cast<std::ptrdiff_t>(evidence.size() / 2);
      std::nth_element(evidence.begin(), half, evidence.end());
      least = *half;
    }
    for (int e : witness_.candidates()) {
      if (next[sz(e)] || !outAndFits(e) || evidence_.likelier[sz(e)] < least || times[sz(e)] >= kExpelled) continue;
      next[sz(e)] = 1;
      ++changes;
      ++admitted;
    }
  }

  // Where odometry is too vague for evidence: the largest groups that support each other and fit as a whole.
  void admitGroups(const std::vector<int>& times) {
    std::map<int, std::vector<double>> chi2;
    for (int e : witness_.candidates())
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
    for (int e : witness_.candidates()) {
      const int name = group_[sz(e)];
      if (next[sz(e)] || times[sz(e)] >= kExpelled || !fitting.count(name) || 2 * chi2[name].size() < largest) continue;
      if (!outAndFits(e)) continue;
      next[sz(e)] = 1;
      ++changes;
      ++admitted;
    }
  }

  // Two parts that nothing joins: the largest group between them, if there are two.
  void join(const AcceptedGraph<D>& graph, const std::vector<int>& times) {
    std::map<std::pair<int, int>, std::map<int, std::vector<int>>> between;
    for (int e : witness_.candidates()) {
      if (in_[sz(e)] || times[sz(e)] >= kExpelled) continue;
      const int a = graph.component(witness_.edge(e).from), b = graph.component(witness_.edge(e).to);
      if (a != b) between[{std::min(a, b), std::max(a, b)}][group_[sz(e)]].push_back(e);
    }
    for (const auto& [parts, groups] : between) {
      const std::vector<int>* best = nullptr;
      for (const auto& [name, members] : groups)
        if (members.size() > 1 && (!best || members.size() > best->size())) best = &members;
      if (!best) continue;
      for (int e : *best) next[sz(e)] = 1;
      changes += best->size();
      admitted += best->size();
      joined = true;
    }
  }

 private:
  double limit(int e) const { return thresholds_.limit[sz(std::max(1, witness_.edge(e).rank))]; }
  bool outAndFits(int e) const { return !in_[sz(e)] && evidence_.chi2[sz(e)] <= limit(e); }

  const Witness<D>& witness_;
  const std::vector<int>& group_;
  const Thresholds& thresholds_;
  const Evidence& evidence_;
  const std::vector<char>& in_;

 public:
  std::vector<char> next;
  std::size_t changes = 0, admitted = 0;
  bool joined = false;
};

}  // namespace

template <int D>
double varianceFactor(const Witness<D>& witness, const std::vector<char>& in, const std::vector<Rigid<D>>& poses,
                      int unknowns, const Thresholds& thresholds, double scale) {
  const double expected = scale < 1.0 ? std::min(1.0, kCaution * scale) : scale;
  std::vector<std::pair<double, int>> squares;
  double redundancy = -static_cast<double>(unknowns) * tangent_size<D>;
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (!in[e]) continue;
    const WhitenedEdge<D>& edge = witness.edge(static_cast<int>(e));
    squares.emplace_back(whitenedError(edge, poses[sz(edge.from)], poses[sz(edge.to)]).squaredNorm(), edge.rank);
    redundancy += edge.rank;
  }
  if (redundancy <= 0.0) return expected;
  const double prior = kPriorTangents * tangent_size<D>;
  double factor = expected;
  for (int i = 0; i < 8; ++i) {
    double sum = prior * expected;
    for (const auto& [square, rank] : squares) sum += std::min(square, factor * thresholds.limit[sz(rank)]);
    factor = std::clamp(sum / (redundancy + prior), std::min(1.0, scale), std::max(1.0, scale));
  }
  return factor;
}

template <int D>
Grown<D> grow(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const Witness<D>& witness,
              const std::vector<int>& group, const Thresholds& thresholds, const InformationScale& scale) {
  Grown<D> grown;
  for (std::size_t e = 0; e < problem.edges.size(); ++e)
    grown.in.push_back(witness.edge(static_cast<int>(e)).rank > 0);  // a link without information joins nothing
  for (int e : witness.candidates()) grown.in[sz(e)] = 0;
  Problem<D> part;
  part.poses = problem.poses;
  bool asserted = false;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    if (grown.in[e] && roles[e] == EdgeRole::Trusted) part.edges.push_back(problem.edges[e]);
    asserted |= roles[e] == EdgeRole::Asserted;
  }
  grown.poses = posesAlongEdges(part);
  AcceptedGraph<D> graph(problem);
  graph.take(grown.in);
  graph.relax(grown.poses, kSteps, kShare, asserted);
  const std::vector<int> small = smallGroups(group);
  std::vector<int> expelled(problem.edges.size(), 0);
  std::set<int> tried;
  for (int round = 0; round < kRounds; ++round) {
    grown.variance = varianceFactor(witness, grown.in, grown.poses, graph.unknowns(), thresholds, scale.factor);
    grown.evidence = witness.hear(graph, grown.in, grown.poses, grown.variance, small);
    if (!grown.evidence.known) break;
    if (round == 0) takeAll(witness, group, small, thresholds, scale, graph, grown);
    Round<D> now(witness, group, thresholds, grown.evidence, grown.in);
    now.expel(expelled);
    now.admit(expelled, thresholds.early_evidence);
    const double few_admitted = 0.01 * static_cast<double>(witness.candidates().size());
    if (static_cast<double>(now.admitted) < few_admitted) now.admit(expelled, Thresholds::kEvidence);
    if (static_cast<double>(now.admitted) < few_admitted) {
      now.admitGroups(expelled);
      now.join(graph, expelled);
    }
    if (now.changes == 0 && !tryGroups(witness, group, thresholds, tried, graph, grown)) break;
    if (now.changes == 0) continue;
    grown.in = std::move(now.next);
    graph.take(grown.in);
    const bool few = static_cast<double>(now.changes) <= kSettled * static_cast<double>(witness.candidates().size());
    const bool much = static_cast<double>(now.admitted) > 0.05 * static_cast<double>(witness.candidates().size());
    graph.relax(grown.poses, kSteps, kShare, now.joined || much || round < 5);
    if (few && !now.joined && !tryGroups(witness, group, thresholds, tried, graph, grown)) break;
  }
  return grown;
}

template double varianceFactor<2>(const Witness<2>&, const std::vector<char>&, const std::vector<Rigid<2>>&, int,
                                  const Thresholds&, double);
template double varianceFactor<3>(const Witness<3>&, const std::vector<char>&, const std::vector<Rigid<3>>&, int,
                                  const Thresholds&, double);
template Grown<2> grow<2>(const Problem<2>&, const std::vector<EdgeRole>&, const Witness<2>&, const std::vector<int>&,
                          const Thresholds&, const InformationScale&);
template Grown<3> grow<3>(const Problem<3>&, const std::vector<EdgeRole>&, const Witness<3>&, const std::vector<int>&,
                          const Thresholds&, const InformationScale&);

}  // namespace pose_graph
