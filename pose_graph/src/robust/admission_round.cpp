// SPDX-License-Identifier: BSD-3-Clause
#include "robust/admission_round.hpp"

#include <cmath>
#include <map>
#include <set>

namespace pose_graph {

namespace {

constexpr std::size_t kFew = 20;  // so many enter at once
constexpr int kExpelled = 2;      // times out: stays out

}  // namespace

template <int D>
bool AdmissionRound<D>::excused(int e, double off) const {
  return off * asStated() <= kDoubt * limit(e) && evidence_.likelier[sz(e)] >= Thresholds::kEvidence &&
         (evidence_.group_chi2[sz(e)] <= kDoubt * thresholds_.limit.back() ||
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
    // Only of those that would not have to leave were they in: as little as modest information asks false ones do as
    // well.
    const double least = evidence_.chi2[sz(e)] <= kDoubt * limit(e) ? likely : Thresholds::kEvidence;
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

template class AdmissionRound<2>;
template class AdmissionRound<3>;

}  // namespace pose_graph
