// SPDX-License-Identifier: BSD-3-Clause
// The decision about the best set: chance, rivals, and rows of neighbouring closures.
#include <algorithm>
#include <cmath>
#include <utility>

#include "robust/decision/selection.hpp"
#include "robust/generators/admission.hpp"

namespace pose_graph {

namespace {

// Log Bayes factor required per row of closures, on average, if variances are beyond kContestedFactor.
constexpr double kEachDecisive = 2.0;
// Number of other rows per unconfirmed row above which it is left out, as in an exchange of groups.
constexpr double kOthers = 8.0;

}  // namespace

template <int D>
bool Selection<D>::isUndecided() const {
  if (contested_ || core_) return !(evidence() >= kDecisive);
  const double loosened = kDecisive + kEachDecisive * evaluator_->rowsInside(best_.hypothesis);
  // Factors estimated from the rows make them more likely; the collapse penalty is about that of all closures.
  if (overOdometry(rowsAlone()) - best_.hypothesis.collapse_penalty >= loosened) return false;
  Hypothesis<D> rows = evaluator_->assessRows(best_.hypothesis, HypothesisEvaluator<D>::kRounds);
  rows.collapse_penalty = 0.0;  // computed for another volume
  applyCollapsePenalty(rows);
  const bool is_loosened = std::max(rows.factors.odometry, rows.factors.closures) > kContestedFactor;
  return !(overOdometry(rows) >= (is_loosened ? loosened : -kDecisive));
}

template <int D>
bool Selection<D>::reliesOnInflatedVariance(const Hypothesis<D>& hypothesis) const {
  if (overOdometry(hypothesis) < kDecisive) return true;
  if (!hypothesis.factors.areBeyond(kContestedFactor)) return false;
  return overOdometry(hypothesis) < kDecisive + kEachDecisive * evaluator_->rowsInside(hypothesis);
}

template <int D>
void Selection<D>::decideByRows() {
  others_.insert(others_.begin(), best_);
  std::vector<Scored> scored{{odometry_.log_evidence, odometry_.in}};
  const Proposal* likeliest = nullptr;
  Hypothesis<D> found;
  for (const Proposal& each : others_) {
    Hypothesis<D> rows = evaluator_->assessRows(each.hypothesis, HypothesisEvaluator<D>::kRounds);
    rows.collapse_penalty = 0.0;
    applyCollapsePenalty(rows);
    if (reliesOnInflatedVariance(rows)) continue;
    rows.log_evidence -= std::exchange(rows.collapse_penalty, 0.0);
    scored.push_back({rows.log_evidence, each.members});
    if (likeliest && !(rows.log_evidence > found.log_evidence)) continue;
    likeliest = &each;
    found = std::move(rows);
  }
  if (!likeliest) return;
  found.in = likeliest->hypothesis.in;
  Proposal chosen = *likeliest;
  chosen.hypothesis = std::move(found);
  best_ = std::move(chosen);
  scored_ = std::move(scored);
  by_rows_ = true;
}

template <int D>
bool Selection<D>::keepShared() {
  const std::optional<std::vector<char>> shared = findShared();
  if (!shared) return false;
  std::vector<EdgeAssessment>& edges = best_.selected.edges;
  bool changed = false;
  for (std::size_t e = 0; e < roles_.size(); ++e) {
    if (roles_[e] != EdgeRole::Candidate || !(edges[e].weight > 0.0) || (*shared)[e]) continue;
    edges[e].weight = 0.0;
    edges[e].verdict = urban_nav_core::ClosureVerdict::Rejected;
    edges[e].reason = Reason::Undecided;
    changed = true;
  }
  if (!changed) return true;
  if (!holdsWithout(best_.selected, best_.slips)) {
    for (const Slip<D>& slip : best_.slips) {
      edges[sz(slip.edge)].weight = 1.0;
      edges[sz(slip.edge)].verdict = urban_nav_core::ClosureVerdict::Accepted;
      edges[sz(slip.edge)].reason = Reason::Role;
    }
  }
  std::vector<char> in;
  for (const EdgeAssessment& edge : edges) in.push_back(edge.weight > 0.0);
  AcceptedGraph<D> graph(problem_);
  graph.take(in);
  graph.relax(best_.selected.poses, kRoundSteps, kRoundShare, true);
  if (core_) return true;
  Hypothesis<D> kept = hypothesisOver(best_.selected, {});
  evaluator_->evaluate(kept);
  best_.hypothesis.factors = kept.factors;  // without the closures left out
  return true;
}

template <int D>
bool Selection<D>::isRescaled() const {
  const VarianceFactors& found = best_.hypothesis.factors;
  return hasVariances() && beyond(found.odometry / found.closures, kContestedFactor) &&
         evaluator_->gainByFactors(best_.hypothesis, by_rows_) >= kDecisive;
}

template <int D>
std::optional<std::vector<char>> Selection<D>::findShared() const {
  std::vector<char> shared = best_.members;
  bool has_rival = contested_ && shareWithSets(shared);
  if (evaluator_ && !evaluator_->areAssertions() && !core_) has_rival |= shareWithoutRows(shared);
  return has_rival ? std::make_optional(shared) : std::nullopt;
}

template <int D>
bool Selection<D>::shareWithSets(std::vector<char>& shared) const {
  bool has_rival = false;
  for (const auto& [log_evidence, in, is_confirmed] : scored_) {
    if (!(log_evidence > best_.hypothesis.log_evidence - kDecisive)) continue;
    std::size_t differ = 0;
    for (std::size_t e = 0; e < roles_.size(); ++e)
      differ += roles_[e] == EdgeRole::Candidate && in[e] != best_.members[e];
    if (!(static_cast<double>(differ) > Thresholds::kContested * static_cast<double>(candidates_))) continue;
    has_rival = true;
    for (std::size_t e = 0; e < shared.size() && is_confirmed; ++e) shared[e] = shared[e] && in[e];
  }
  return has_rival;
}

template <int D>
bool Selection<D>::shareWithoutRows(std::vector<char>& shared) const {
  const std::vector<std::vector<int>> rows = evaluator_->unconfirmedRows(best_.hypothesis);
  if (rows.empty()) return false;
  const Hypothesis<D>& all = rowsAlone();
  const std::vector<double> losses = evaluator_->estimateLosses(all, best_.hypothesis, rows);
  std::vector<int> nearly_as_likely;  // closures of such rows
  double rivals = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (losses[r] >= 2.0 * kDecisive) continue;  // linearisation is sufficiently accurate
    Hypothesis<D> rest = best_.hypothesis;
    for (const int e : rows[r]) rest.in[sz(e)] = 0;
    const Hypothesis<D> without = evaluator_->assessRows(rest, 0);
    if (!(all.log_evidence - without.log_evidence < kDecisive)) continue;
    if (best_.slips.empty() && !evaluator_->isDisplaced(without.poses, all.poses)) continue;
    nearly_as_likely.insert(nearly_as_likely.end(), rows[r].begin(), rows[r].end());
    ++rivals;
  }
  // Among few rows, missing confirmation does not indicate an error.
  if (evaluator_->rowsInside(best_.hypothesis) >= kOthers * rivals) {
    for (const int e : nearly_as_likely) shared[sz(e)] = 0;
  }
  return rivals > 0.0;
}

template <int D>
const Hypothesis<D>& Selection<D>::rowsAlone() const {
  if (!rows_alone_) rows_alone_ = evaluator_->assessRows(best_.hypothesis, 0);
  return *rows_alone_;
}

template class Selection<2>;
template class Selection<3>;

}  // namespace pose_graph
