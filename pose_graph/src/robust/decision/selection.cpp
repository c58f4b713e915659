// SPDX-License-Identifier: BSD-3-Clause
#include "robust/decision/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "robust/evidence/closure_loops.hpp"
#include "robust/generators/admission.hpp"
#include "robust/generators/session_links.hpp"

namespace pose_graph {

namespace {

constexpr int kRow = 5;  // of the closures of a group outside, one in kRow is used
// Work limit relative to the best set, and absolute (block multiplications, a fraction of a second). Sets above both
// contain false closures between distant places that fill the factor; none was better in tests.
constexpr double kDense = 20.0, kSoonFactored = 1e7;
// Number of poses above which an uncontested set is not scored, and above which only one selection is run; it is
// scored if the core graph of the chains is not larger than that.
constexpr std::size_t kManyPoses = 20000, kMostPoses = 200000;

}  // namespace

template <int D>
void Selection<D>::run() {
  best_.selected = selectEdges(problem_, roles_);
  if (candidates_ == 0) return;
  if (problem_.poses.size() > kManyPoses && !isContested(best_.selected)) return;
  if (problem_.poses.size() > kMostPoses) {
    evaluateReducedGraph();
    return;
  }
  parts_ = sessionParts(problem_, roles_);
  for (std::size_t e = 0; e < roles_.size(); ++e) between_ += isBetween(e);
  contested_ = isContested(best_.selected) || between_ > 0;
  evaluator_ = std::make_unique<HypothesisEvaluator<D>>(problem_, roles_);
  odometry_ = evaluator_->evaluateOdometry();
  scored_.push_back({odometry_.log_evidence, odometry_.in});
  best_.hypothesis = hypothesisOver(best_.selected, {});
  evaluator_->evaluate(best_.hypothesis);
  readmit(best_);
  applyCollapsePenalty(best_.hypothesis);
  scored_.push_back({best_.hypothesis.log_evidence, best_.members});
  if (between_ > 0 && rejected(best_.selected) == 0 && !isLoosened()) unopposed_ = best_.selected;
  if (!contested_) {
    // A short slip affects few closures; a single one does not contradict a step.
    if (rejected(best_.selected) > 1) proposeSlips({});
    // False closures also fit if the stated variances are far too large.
    if (!evaluator_->areAssertions() && evidence() < kDecisive)
      contested_ = propose({1.0 / kFarFactor, 1.0 / kFarFactor}, slips_);
    if (contested_) repeatWithFactors();
    return;
  }
  if (between_ > 0) joinSessions();
  proposeSlips({});
  if (!evaluator_->areAssertions()) tryScales();
  if (between_ == 0 && !evaluator_->areAssertions() && evidence() < kDecisive) decideByRows();
}

template <int D>
std::vector<char> Selection<D>::inUncontestedParts() const {
  std::vector<char> uncontested(problem_.poses.size(), 0), contested_part = uncontested;
  if (core_ || !contested_ || isLoosened()) return uncontested;
  for (std::size_t e = 0; e < roles_.size(); ++e) {
    if (!isBetween(e) && (best_.hypothesis.in[e] || roles_[e] != EdgeRole::Candidate)) continue;
    contested_part[sz(parts_[sz(problem_.edges[e].from)])] = contested_part[sz(parts_[sz(problem_.edges[e].to)])] = 1;
  }
  for (std::size_t i = 0; i < uncontested.size(); ++i) uncontested[i] = !contested_part[sz(parts_[i])];
  return uncontested;
}

template <int D>
std::ptrdiff_t Selection<D>::rejected(const SelectedEdges<D>& selected) const {
  return std::count_if(selected.edges.begin(), selected.edges.end(), [](const EdgeAssessment& edge) {
    return edge.verdict == urban_nav_core::ClosureVerdict::Rejected;
  });
}

template <int D>
Hypothesis<D> Selection<D>::hypothesisOver(const SelectedEdges<D>& selected, const VarianceFactors& factors) const {
  Hypothesis<D> made;
  for (std::size_t e = 0; e < roles_.size(); ++e) made.in.push_back(selected.edges[e].weight > 0.0);
  made.poses = selected.poses;
  made.factors = factors;
  return made;
}

template <int D>
SelectedEdges<D> Selection<D>::selectProposed(const VarianceFactors& factors, double most_work) const {
  Problem<D> part = proposed_.withoutEdges();
  std::vector<EdgeRole> roles;
  std::vector<std::size_t> names;
  for (std::size_t e = 0; e < proposed_roles_.size(); ++e) {
    if (e < barred_.size() && barred_[e]) continue;
    part.edges.push_back(proposed_.edges[e]);
    roles.push_back(proposed_roles_[e]);
    names.push_back(e);
  }
  SelectedEdges<D> selected = selectEdges(withFactors(std::move(part), roles, factors), roles, most_work), made;
  made.is_too_dense = selected.is_too_dense;
  if (made.is_too_dense) return made;
  made.poses = std::move(selected.poses);
  made.variance = selected.variance;
  EdgeAssessment left_out;
  left_out.weight = 0.0;
  left_out.verdict = urban_nav_core::ClosureVerdict::Rejected;
  left_out.reason = Reason::NoWitness;
  left_out.dof = kTangentSize<D>;
  made.edges.assign(roles_.size(), left_out);
  for (std::size_t k = 0; k < names.size(); ++k) {
    for (int& other : selected.edges[k].contradicted_by) other = static_cast<int>(names[sz(other)]);
    if (names[k] < roles_.size()) made.edges[names[k]] = std::move(selected.edges[k]);
  }
  return made;
}

template <int D>
bool Selection<D>::holdsWithout(const SelectedEdges<D>& selected, const std::vector<Slip<D>>& slips) const {
  std::vector<char> in;
  for (const EdgeAssessment& edge : selected.edges) in.push_back(edge.weight > 0.0);
  return joinEndsWithoutAnyRow(problem_, roles_, in, evaluator_->rows(), slips);
}

template <int D>
void Selection<D>::readmit(Proposal& proposal) const {
  proposal.members = proposal.hypothesis.in;
  const double stated = 1.0 / std::min(1.0, proposal.found_with.closures);
  if (stated > 1.0 && rejected(proposal.selected) > 0) readmit(proposal, stated, std::vector<char>(roles_.size(), 1));
  const std::vector<char> in_rows = evaluator_->outsideAcceptedRows(proposal.members);
  if (std::count(in_rows.begin(), in_rows.end(), 1) > 0) readmit(proposal, sampledMargin() * stated, in_rows);
}

template <int D>
void Selection<D>::readmit(Proposal& proposal, double own, const std::vector<char>& some) const {
  const std::vector<char> fitting = findFitting(withFactors(proposed_, proposed_roles_, proposal.found_with),
                                                proposed_roles_, proposedFrom(proposal.hypothesis.in, 1),
                                                proposal.hypothesis.poses, proposedFrom(evaluator_->rows(), -1), own);
  for (std::size_t e = 0; e < roles_.size(); ++e) {
    if (!fitting[e] || !some[e] || (e < barred_.size() && barred_[e])) continue;
    proposal.members[e] = 1;
    proposal.selected.edges[e].weight = 1.0;
    proposal.selected.edges[e].verdict = urban_nav_core::ClosureVerdict::Accepted;
    proposal.selected.edges[e].reason = Reason::Fits;
  }
}

template <int D>
std::size_t Selection<D>::countLinking(const Hypothesis<D>& hypothesis) const {
  std::size_t linking = 0;
  for (std::size_t e = 0; e < roles_.size(); ++e)
    linking += isBetween(e) && hypothesis.in[e] && !best_.hypothesis.in[e];
  return linking;
}

template <int D>
double Selection<D>::mostWork() const {
  return std::max(kSoonFactored, kDense * AcceptedGraph<D>(problem_).work(best_.hypothesis.in, true));
}

template <int D>
bool Selection<D>::propose(const VarianceFactors& factors, const std::vector<Slip<D>>& slips, bool forced,
                           bool is_doubtful_link) {
  Proposal made;
  made.slips = slips;
  made.found_with = factors;
  made.selected = selectProposed(factors, forced ? std::numeric_limits<double>::infinity() : mostWork());
  if (made.selected.is_too_dense) return false;
  for (const Slip<D>& slip : slips) {
    EdgeAssessment& edge = made.selected.edges[sz(slip.edge)];
    edge.weight = 0.0;
    edge.verdict = urban_nav_core::ClosureVerdict::Rejected;
    edge.reason = Reason::Slipped;
  }
  made.hypothesis = hypothesisOver(made.selected, factors);
  readmit(made);
  const bool known =
      std::any_of(scored_.begin(), scored_.end(), [&](const auto& other) { return other.members == made.members; });
  if (known && !forced && !is_doubtful_link) return false;
  evaluator_->evaluate(made.hypothesis);
  const bool is_new_slip = slips.size() > best_.slips.size();
  const bool is_confirmed = !is_new_slip || holdsWithout(made.selected, slips);
  scored_.push_back({made.hypothesis.log_evidence, made.members, is_confirmed});
  const bool likelier = made.hypothesis.log_evidence >
                            best_.hypothesis.log_evidence + (is_new_slip || is_doubtful_link ? kDecisive : 0.0) &&
                        is_confirmed &&
                        (!is_doubtful_link || countLinking(made.hypothesis) >= std::min(kLeastWeakLink, between_));
  if (likelier || forced) applyCollapsePenalty(made.hypothesis);
  const bool is_kept = forced || (likelier && !reliesOnInflatedVariance(made.hypothesis));
  if (is_kept) std::swap(best_, made);
  if (made.slips.empty()) others_.push_back(std::move(made));
  return is_kept;
}

template <int D>
void Selection<D>::evaluateReducedGraph() {
  core_ = CoreGraph<D>::of(problem_, roles_);
  unweighed_ = !core_ || core_->problem().poses.size() > kMostPoses;
  if (unweighed_) return;
  contested_ = true;
  HypothesisEvaluator<D> along_odometry(core_->problem(), core_->roles());
  odometry_ = along_odometry.evaluateOdometry();
  const double log_evidence = odometry_.log_evidence;
  odometry_.poses = core_->expanded(odometry_.poses);
  Hypothesis<D> made;
  for (std::size_t i = 0; i < core_->problem().poses.size(); ++i)
    made.poses.push_back(best_.selected.poses[sz(core_->pose(static_cast<int>(i)))]);
  for (std::size_t e = 0; e < core_->problem().edges.size(); ++e) {
    const int edge = core_->edge(static_cast<int>(e));
    made.in.push_back(edge < 0 || best_.selected.edges[sz(edge)].weight > 0.0);
  }
  core_->expanded(made.poses);
  core_->relinearise();
  evaluator_ = std::make_unique<HypothesisEvaluator<D>>(core_->problem(), core_->roles());
  evaluator_->evaluateOdometry();
  evaluator_->evaluate(made);
  best_.hypothesis = std::move(made);
  odometry_.log_evidence = log_evidence;
  applyCollapsePenalty(best_.hypothesis);
}

template <int D>
void Selection<D>::addLink(int closure) {
  proposed_.edges.push_back(problem_.edges[sz(closure)]);
  proposed_roles_.push_back(EdgeRole::Trusted);
}

template <int D>
void Selection<D>::barUnlinked() {
  const std::vector<int> linked = sessionParts(proposed_, proposed_roles_);
  barred_.assign(roles_.size(), 0);
  for (std::size_t e = 0; e < roles_.size(); ++e)
    barred_[e] = isBetween(e) && linked[sz(problem_.edges[e].from)] != linked[sz(problem_.edges[e].to)];
}

template <int D>
void Selection<D>::joinSessions() {
  std::vector<char> within = best_.hypothesis.in;
  for (std::size_t e = 0; e < within.size(); ++e) {
    if (isBetween(e)) within[e] = 0;
  }
  const SessionLinks links =
      linkSessions(withFactors(problem_, roles_, best_.hypothesis.factors), roles_, within, best_.hypothesis.poses);
  for (const int closure : links.agreed) addLink(closure);
  barUnlinked();
  bool wrongly_joined = false;
  for (std::size_t e = 0; e < roles_.size(); ++e) wrongly_joined |= barred_[e] && best_.hypothesis.in[e];
  if (!links.agreed.empty() || wrongly_joined) propose({}, {}, wrongly_joined);
  std::vector<char> tried(roles_.size(), 0);
  for (const int closure : links.doubtful) {
    if (!barred_[sz(closure)] || tried[sz(closure)] || tryLink(closure)) continue;
    for (std::size_t e = 0; e < tried.size(); ++e) tried[e] |= scored_.back().members[e];
  }
}

template <int D>
bool Selection<D>::tryLink(int closure) {
  const Problem<D> before = proposed_;
  addLink(closure);
  barUnlinked();
  if (propose({}, {}, false, true)) return true;
  proposed_ = before;
  proposed_roles_.pop_back();
  barUnlinked();
  return false;
}

template <int D>
typename Selection<D>::Considered Selection<D>::considerConfirmed(const Problem<D>& scaled) const {
  std::vector<int> candidates;
  for (std::size_t e = 0; e < proposed_roles_.size(); ++e)
    if (proposed_roles_[e] == EdgeRole::Candidate) candidates.push_back(static_cast<int>(e));
  const DeadReckoning<D> reckoning(scaled, proposed_roles_);
  const Thresholds thresholds(candidates.size(), kTangentSize<D>);
  const std::vector<int> group =
      consistentGroups(scaled.edges.size(), ClosureLoops<D>(scaled, candidates, reckoning), 1.0, thresholds);
  std::vector<int> members(scaled.edges.size(), 0);
  for (const int e : candidates) ++members[sz(group[sz(e)])];
  Considered made{best_.hypothesis.in, {}};
  made.confirmed.resize(proposed_roles_.size(), 1);
  made.thinned = made.confirmed;
  std::vector<int> before(scaled.edges.size(), 0);
  for (const int e : candidates) {
    if (made.thinned[sz(e)] || members[sz(group[sz(e)])] < 2) continue;
    made.confirmed[sz(e)] = 1;
    made.thinned[sz(e)] = before[sz(group[sz(e)])]++ % kRow == 0;
  }
  return made;
}

template <int D>
void Selection<D>::proposeSlips(const VarianceFactors& factors) {
  const Problem<D> scaled = withFactors(proposed_, proposed_roles_, best_.hypothesis.factors);
  const std::vector<char> in = proposedFrom(best_.hypothesis.in, 1);
  const auto may_slip = [&](const std::vector<char>& some) {
    return maySlip(scaled, proposed_roles_, in, some, proposedFrom(evaluator_->rows(), -1), best_.hypothesis.poses);
  };
  if (rejected(best_.selected) == 0 && !may_slip(in)) return;
  Considered some = considerConfirmed(scaled);
  std::vector<char> considered = std::move(some.confirmed), all(scaled.edges.size(), 1);
  const AcceptedGraph<D> graph(scaled);
  const double all_work = graph.work(all, true), in_work = graph.work(in, true);
  if (all_work <= kWork * graph.work(considered, true)) considered = std::move(all);
  if (all_work > kWork * in_work && !may_slip(considered)) return;
  // Rows of false closures between distant places would fill the factor.
  if (graph.work(considered, true) > kWork * in_work) considered = std::move(some.thinned);
  if (proposeWithoutSlips(findSlips(scaled, proposed_roles_, considered, {}, odometry_.poses), factors)) return;
  // From odometry, a slip that closures nearby appear to confirm is not found. A set that is no better than chance
  // contradicts nothing.
  if (evidence() < kDecisive) return;
  const std::vector<char> weighted_down = mostContradicted(scaled, proposed_roles_, in, considered);
  if (!weighted_down.empty())
    proposeWithoutSlips(findSlips(scaled, proposed_roles_, considered, weighted_down, odometry_.poses), factors);
}

template <int D>
bool Selection<D>::proposeWithoutSlips(std::vector<Slip<D>> slips, const VarianceFactors& factors) {
  slips.erase(std::remove_if(slips.begin(), slips.end(),
                             [&](const Slip<D>& slip) { return slip.edge >= static_cast<int>(roles_.size()); }),
              slips.end());
  if (slips.empty()) return false;
  slips_ = std::move(slips);
  const Problem<D> before = proposed_;
  for (const Slip<D>& slip : slips_) {
    proposed_.edges[sz(slip.edge)].Z = slip.T_from_to;
    proposed_.edges[sz(slip.edge)].information *= 1.0 / kFarFactor;
  }
  if (propose(factors, slips_)) return true;
  proposed_ = before;
  slips_.clear();
  return false;
}

template <int D>
void Selection<D>::tryScales() {
  if (!isContested(best_.selected) && !best_.hypothesis.factors.areBeyond(kContestedFactor)) return;
  const auto try_with = [&](const VarianceFactors& factors) {
    if (!isUnquestioned() && factors.odometry <= evaluator_->largestOdometryFactor()) propose(factors, slips_);
  };
  const bool looser = evidence() < kDecisive || evaluator_->mayFitLooser(best_.hypothesis, best_.selected.edges);
  if (looser) try_with({kFarFactor, kFarFactor});  // overconfident information excludes true closures
  if (!isCredible()) {
    if (looser) try_with({kFarFactor, 1.0});
    if (looser) try_with({1.0, kFarFactor});
    try_with({1.0 / kFarFactor, 1.0 / kFarFactor});
  }
  repeatWithFactors();
  // If variances were stated too large, a slip may become apparent only now.
  if (slips_.empty() && evidence() >= kDecisive && !best_.found_with.areWithin(kSameFactor, {}))
    proposeSlips(best_.found_with);
}

template <int D>
bool Selection<D>::agreesWithItself() {
  if (evidence() < kDecisive) return false;
  if (!best_.is_contradicted) {
    const Hypothesis<D>& best = best_.hypothesis;
    best_.is_contradicted = contradictsItself(
        withFactors(proposed_, proposed_roles_, best.factors), proposed_roles_, proposedFrom(best.in, 1), best.poses,
        proposedFrom(evaluator_->rows(), -1), std::max(1.0, 1.0 / best.factors.closures));
  }
  return !*best_.is_contradicted;
}

template <int D>
void Selection<D>::repeatWithFactors() {
  for (int i = 0; i < kRepeats && !isSettled() && !(isTighter() && agreesWithItself()); ++i) {
    const VarianceFactors now = best_.hypothesis.factors;
    repeated_with_ = now;
    if (!propose(now, slips_)) return;
  }
}

template class Selection<2>;
template class Selection<3>;

}  // namespace pose_graph
