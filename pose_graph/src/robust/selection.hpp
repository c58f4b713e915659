// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "robust/admission_thresholds.hpp"
#include "robust/consistent_groups.hpp"
#include "robust/core_graph.hpp"
#include "robust/hypothesis.hpp"
#include "robust/judgement.hpp"
#include "robust/session_links.hpp"
#include "robust/slips.hpp"
#include "robust/unique_edges.hpp"

namespace pose_graph {

// Logarithm of the Bayes factor that a set of closures needs over odometry alone, and over another set to be decided.
constexpr double kDecisive = 7.0;
// And on average for each row of closures where variances are off beyond kContestedFactor.
constexpr double kEachDecisive = 2.0;
// A selection is contested where more than this share of the closures is rejected, or their variances are beyond that.
constexpr double kContestedShare = 0.02, kContestedFactor = 9.0;
constexpr int kRow = 5;         // of closures in a row outside, one in so many stands for the others
constexpr double kFar = 100.0;  // of variances that are tried
// What takes so many times the work of the best set to factor, and more than a fraction of a second (multiplications of
// blocks), has false closures between far places that fill the factor: no other set has been worth its minutes.
constexpr double kDense = 20.0, kSoonFactored = 1e7;
constexpr double kRegrowFactor = 1.4;  // of variances: less changes hardly a verdict
constexpr int kRegrows = 3;
constexpr double kHealedShare = 0.01;  // of a step's information that what takes its place has
// Beyond so many poses what nothing contests is not judged, and beyond so many one selection is all that there is time
// for, weighed where the chains of a graph leave a core that is no larger.
constexpr std::size_t kManyPoses = 20000, kMostPoses = 200000;

/// Proposes sets of edges, and keeps the best.
template <int D>
class Selection {
 public:
  Selection(const Problem<D>& problem, const std::vector<EdgeRole>& roles)
      : problem_(problem), roles_(roles), proposed_(problem), proposed_roles_(roles) {
    for (const EdgeRole role : roles) candidates_ += role == EdgeRole::Candidate;
  }

  void run() {
    best_.assessed = judgeGraph(problem_, roles_);
    if (candidates_ == 0) return;
    if (problem_.poses.size() > kManyPoses && !isContested(best_.assessed)) return;
    if (problem_.poses.size() > kMostPoses) {
      weighCore();
      return;
    }
    parts_ = sessionParts(problem_, roles_);
    for (std::size_t e = 0; e < roles_.size(); ++e) between_ += isBetween(e);
    contested_ = isContested(best_.assessed) || between_ > 0;
    evaluator_ = std::make_unique<HypothesisEvaluator<D>>(problem_, roles_);
    odometry_ = evaluator_->evaluateOdometry();
    weighed_.emplace_back(odometry_.log_evidence, odometry_.in);
    best_.hypothesis = hypothesisOver(best_.assessed, {});
    evaluator_->evaluate(best_.hypothesis);
    contract(best_.hypothesis);
    weighed_.emplace_back(best_.hypothesis.log_evidence, best_.hypothesis.in);
    if (between_ > 0 && rejected(best_.assessed) == 0 && !isLoosened()) unopposed_ = best_.assessed;
    if (!contested_) {
      // A short slip costs few closures; one alone refutes no step.
      if (rejected(best_.assessed) > 1) heal({});
      // False closures fit too where variances are stated far too large.
      if (!evaluator_->areAssertions() && evidence() < kDecisive)
        contested_ = propose({1.0 / kFar, 1.0 / kFar}, slips_);
      if (contested_) regrow();
      return;
    }
    if (between_ > 0) link();
    heal({});
    if (!evaluator_->areAssertions()) rescale();
  }

  /// Whether sets of edges were weighed against odometry alone.
  bool wasJudged() const { return evaluator_ != nullptr; }
  /// Whether other sets than the first one were looked at.
  bool wasContested() const { return contested_; }
  /// Whether the best set is no likelier than chance, or fits because variances were enlarged until it did. A set that
  /// nothing contests remains unless chance is decidedly the likelier.
  bool isUndecided() const {
    if (contested_ || core_) return !(evidence() >= kDecisive);
    const Hypothesis<D> rows = evaluator_->assessRows(best_.hypothesis, HypothesisEvaluator<D>::kRounds);
    const bool is_loosened = std::max(rows.factors.odometry, rows.factors.closures) > kContestedFactor;
    const double loosened = kDecisive + kEachDecisive * evaluator_->rowsInside(best_.hypothesis);
    return !(overOdometry(rows) >= (is_loosened ? loosened : -kDecisive));
  }
  /// Poses by all closures, where some join sessions, and none is rejected or fits because variances were enlarged: few
  /// closures outweigh no chance.
  const std::optional<Judgement<D>>& unopposed() const { return unopposed_; }
  /// By pose, whether no closure of its part, which odometry holds together, is rejected or leads to another part. None
  /// where closures fit because variances were enlarged.
  std::vector<char> inUncontestedParts() const {
    std::vector<char> uncontested(problem_.poses.size(), 0), contested_part = uncontested;
    if (core_ || !contested_ || isLoosened()) return uncontested;
    for (std::size_t e = 0; e < roles_.size(); ++e) {
      if (!isBetween(e) && best_.assessed.edges[e].verdict != urban_nav_core::ClosureVerdict::Rejected) continue;
      contested_part[sz(parts_[sz(problem_.edges[e].from)])] = contested_part[sz(parts_[sz(problem_.edges[e].to)])] = 1;
    }
    for (std::size_t i = 0; i < uncontested.size(); ++i) uncontested[i] = !contested_part[sz(parts_[i])];
    return uncontested;
  }
  /// Whether sets should have been weighed, and the graph is too large.
  bool isUnweighed() const { return unweighed_; }
  /// Leaves out of the best set what a rival, another set of edges that is nearly as likely, does not share: closures that
  /// are not in both become undecided. Where the rest no longer joins the ends of a slip, the step is odometry again. The
  /// poses are relaxed anew. Returns whether there is a rival.
  bool keepShared() {
    const std::optional<std::vector<char>> shared = findShared();
    if (!shared) return false;
    std::vector<EdgeAssessment>& edges = best_.assessed.edges;
    bool changed = false;
    for (std::size_t e = 0; e < roles_.size(); ++e) {
      if (roles_[e] != EdgeRole::Candidate || !(edges[e].weight > 0.0) || (*shared)[e]) continue;
      edges[e].weight = 0.0;
      edges[e].verdict = urban_nav_core::ClosureVerdict::Rejected;
      edges[e].reason = Reason::Undecided;
      changed = true;
    }
    if (!changed) return true;
    if (!holdsWithout(best_.assessed, best_.slips)) {
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
    graph.relax(best_.assessed.poses, kRoundSteps, kRoundShare, true);
    return true;
  }
  bool hasVariances() const { return evaluator_ && !evaluator_->areAssertions(); }
  /// Whether the variances of odometry and closures are off against each other by far, and that is no chance.
  bool isRescaled() const {
    const VarianceFactors& found = best_.hypothesis.factors;
    return hasVariances() && beyond(found.odometry / found.closures, kContestedFactor) &&
           evaluator_->gainByFactors(best_.hypothesis) >= kDecisive;
  }
  bool isThinlyJoined() const { return between_ < kLeastWeakLink; }
  bool rejectsAny() const { return rejected(best_.assessed) > 0; }
  double evidence() const { return overOdometry(best_.hypothesis); }
  const Hypothesis<D>& odometryAlone() const { return odometry_; }
  const Hypothesis<D>& hypothesis() const { return best_.hypothesis; }
  Judgement<D> take() { return std::move(best_.assessed); }

 private:
  struct Proposal {
    Judgement<D> assessed;
    Hypothesis<D> hypothesis;
    std::vector<Slip<D>> slips;
    VarianceFactors grown_with;
  };

  // Edges that the best set and all its rivals have; none where there is no rival.
  std::optional<std::vector<char>> findShared() const {
    std::vector<char> shared = best_.hypothesis.in;
    bool has_rival = contested_ && shareWithSets(shared);
    if (evaluator_ && !evaluator_->areAssertions() && !core_) has_rival |= shareWithoutRows(shared);
    return has_rival ? std::make_optional(shared) : std::nullopt;
  }

  // Takes out of `shared` what sets nearly as likely have not. Returns whether there are any.
  bool shareWithSets(std::vector<char>& shared) const {
    bool has_rival = false;
    for (const auto& [log_evidence, in] : weighed_) {
      if (!(log_evidence > best_.hypothesis.log_evidence - kDecisive)) continue;
      std::size_t differ = 0;
      for (std::size_t e = 0; e < roles_.size(); ++e)
        differ += roles_[e] == EdgeRole::Candidate && in[e] != best_.hypothesis.in[e];
      if (!(static_cast<double>(differ) > kContestedShare * static_cast<double>(candidates_))) continue;
      has_rival = true;
      for (std::size_t e = 0; e < shared.size(); ++e) shared[e] = shared[e] && in[e];
    }
    return has_rival;
  }

  // Takes out of `shared` each row of closures that no other confirms, where the map is another one without it, and nearly
  // as likely. Returns whether there are any.
  bool shareWithoutRows(std::vector<char>& shared) const {
    const std::vector<std::vector<int>> rows = evaluator_->unconfirmedRows(best_.hypothesis);
    if (rows.empty()) return false;
    const Hypothesis<D> all = evaluator_->assessRows(best_.hypothesis, 0);
    bool has_rival = false;
    for (const std::vector<int>& row : rows) {
      Hypothesis<D> without = best_.hypothesis;
      for (const int e : row) without.in[sz(e)] = 0;
      without = evaluator_->assessRows(without, 0);
      if (!(all.log_evidence - without.log_evidence < kDecisive)) continue;
      if (best_.slips.empty() && !evaluator_->isDisplaced(without.poses, all.poses)) continue;
      has_rival = true;
      for (const int e : row) shared[sz(e)] = 0;
    }
    return has_rival;
  }

  double overOdometry(const Hypothesis<D>& hypothesis) const {
    return hypothesis.log_evidence - hypothesis.by_contraction - odometry_.log_evidence;
  }
  bool isLoosened() const {
    const VarianceFactors& factors = best_.hypothesis.factors;
    return std::max({best_.assessed.variance, factors.odometry, factors.closures}) > kContestedFactor;
  }
  std::ptrdiff_t rejected(const Judgement<D>& judged) const {
    return std::count_if(judged.edges.begin(), judged.edges.end(), [](const EdgeAssessment& edge) {
      return edge.verdict == urban_nav_core::ClosureVerdict::Rejected;
    });
  }
  bool rejectsMany(const Judgement<D>& judged) const {
    return static_cast<double>(rejected(judged)) > kContestedShare * static_cast<double>(candidates_);
  }
  bool isContested(const Judgement<D>& judged) const {
    return candidates_ > 0 && (rejectsMany(judged) || beyond(judged.variance, kContestedFactor));
  }
  bool takesNearlyAll() const { return !rejectsMany(best_.assessed) && evidence() >= kDecisive; }

  Hypothesis<D> hypothesisOver(const Judgement<D>& judged, const VarianceFactors& factors) const {
    Hypothesis<D> made;
    for (std::size_t e = 0; e < roles_.size(); ++e) made.in.push_back(judged.edges[e].weight > 0.0);
    made.poses = judged.poses;
    made.factors = factors;
    return made;
  }

  // Takes off what is no evidence, where that decides anything.
  void contract(Hypothesis<D>& hypothesis) const {
    if (overOdometry(hypothesis) > 0.0) hypothesis.by_contraction = evaluator_->gainByContraction(hypothesis);
  }

  // Whether a set fits because variances were changed until it did: each row is then hardly likelier than chance.
  bool isInflated(const Hypothesis<D>& hypothesis) const {
    if (overOdometry(hypothesis) < kDecisive) return true;
    if (!hypothesis.factors.areBeyond(kContestedFactor)) return false;
    return overOdometry(hypothesis) < kDecisive + kEachDecisive * evaluator_->rowsInside(hypothesis);
  }

  bool isBetween(std::size_t e) const {
    return roles_[e] == EdgeRole::Candidate && parts_[sz(problem_.edges[e].from)] != parts_[sz(problem_.edges[e].to)];
  }

  // Judges the proposed graph without what is barred.
  Judgement<D> judgeProposed(const VarianceFactors& factors, double most_work) const {
    Problem<D> part = proposed_.withoutEdges();
    std::vector<EdgeRole> roles;
    std::vector<std::size_t> names;
    for (std::size_t e = 0; e < proposed_roles_.size(); ++e) {
      if (e < barred_.size() && barred_[e]) continue;
      part.edges.push_back(proposed_.edges[e]);
      roles.push_back(proposed_roles_[e]);
      names.push_back(e);
    }
    Judgement<D> judged = judgeGraph(withFactors(std::move(part), roles, factors), roles, most_work), made;
    made.is_too_dense = judged.is_too_dense;
    if (made.is_too_dense) return made;
    made.poses = std::move(judged.poses);
    made.variance = judged.variance;
    EdgeAssessment left_out;
    left_out.weight = 0.0;
    left_out.verdict = urban_nav_core::ClosureVerdict::Rejected;
    left_out.reason = Reason::NoWitness;
    left_out.dof = kTangentSize<D>;
    made.edges.assign(roles_.size(), left_out);
    for (std::size_t k = 0; k < names.size(); ++k) {
      for (int& other : judged.edges[k].contradicted_by) other = static_cast<int>(names[sz(other)]);
      if (names[k] < roles_.size()) made.edges[names[k]] = std::move(judged.edges[k]);
    }
    return made;
  }

  // Whether what is accepted joins the two ends of each slip: where nothing does, nothing has refuted the step.
  bool holdsWithout(const Judgement<D>& judged, const std::vector<Slip<D>>& slips) const {
    DisjointSets joined(problem_.poses.size());
    joined.joinAll(problem_.fixed);
    for (std::size_t e = 0; e < judged.edges.size(); ++e)
      if (judged.edges[e].weight > 0.0) joined.join(problem_.edges[e].from, problem_.edges[e].to);
    return std::all_of(slips.begin(), slips.end(), [&](const Slip<D>& slip) {
      const Edge<D>& edge = problem_.edges[sz(slip.edge)];
      return joined.areJoined(edge.from, edge.to);
    });
  }

  // Closures between parts that the best set has not.
  std::size_t countLinking(const Hypothesis<D>& hypothesis) const {
    std::size_t linking = 0;
    for (std::size_t e = 0; e < roles_.size(); ++e)
      linking += isBetween(e) && hypothesis.in[e] && !best_.hypothesis.in[e];
    return linking;
  }

  double mostWork() const {
    return std::max(kSoonFactored, kDense * AcceptedGraph<D>(problem_).work(best_.hypothesis.in, true));
  }

  // Judges the proposed graph with these factors; keeps what is better. Returns whether it was.
  bool propose(const VarianceFactors& factors, const std::vector<Slip<D>>& slips, bool forced = false,
               bool is_doubtful_link = false) {
    Proposal made;
    made.slips = slips;
    made.grown_with = factors;
    made.assessed = judgeProposed(factors, forced ? std::numeric_limits<double>::infinity() : mostWork());
    if (made.assessed.is_too_dense) return false;
    for (const Slip<D>& slip : slips) {
      EdgeAssessment& edge = made.assessed.edges[sz(slip.edge)];
      edge.weight = 0.0;
      edge.verdict = urban_nav_core::ClosureVerdict::Rejected;
      edge.reason = Reason::Slipped;
    }
    made.hypothesis = hypothesisOver(made.assessed, factors);
    const bool known = std::any_of(weighed_.begin(), weighed_.end(),
                                   [&](const auto& other) { return other.second == made.hypothesis.in; });
    if (known && !forced && !is_doubtful_link) return false;
    evaluator_->evaluate(made.hypothesis);
    weighed_.emplace_back(made.hypothesis.log_evidence, made.hypothesis.in);
    const bool is_new_slip = slips.size() > best_.slips.size();
    const bool likelier = made.hypothesis.log_evidence >
                              best_.hypothesis.log_evidence + (is_new_slip || is_doubtful_link ? kDecisive : 0.0) &&
                          (!is_new_slip || holdsWithout(made.assessed, slips)) &&
                          (!is_doubtful_link || countLinking(made.hypothesis) >= std::min(kLeastWeakLink, between_));
    if (likelier || forced) contract(made.hypothesis);
    if (!forced && (!likelier || isInflated(made.hypothesis))) return false;
    best_ = std::move(made);
    return true;
  }

  // Weighs the one selection of a large graph against odometry alone, by its core.
  void weighCore() {
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
      made.poses.push_back(best_.assessed.poses[sz(core_->pose(static_cast<int>(i)))]);
    for (std::size_t e = 0; e < core_->problem().edges.size(); ++e) {
      const int edge = core_->edge(static_cast<int>(e));
      made.in.push_back(edge < 0 || best_.assessed.edges[sz(edge)].weight > 0.0);
    }
    core_->expanded(made.poses);
    core_->relinearise();
    evaluator_ = std::make_unique<HypothesisEvaluator<D>>(core_->problem(), core_->roles());
    evaluator_->evaluateOdometry();
    evaluator_->evaluate(made);
    best_.hypothesis = std::move(made);
    odometry_.log_evidence = log_evidence;
    contract(best_.hypothesis);
  }

  // Takes what a closure between two parts says as given.
  void addLink(int closure) {
    proposed_.edges.push_back(problem_.edges[sz(closure)]);
    proposed_roles_.push_back(EdgeRole::Trusted);
  }

  // Bars closures between parts that no link joins.
  void barUnlinked() {
    const std::vector<int> linked = sessionParts(proposed_, proposed_roles_);
    barred_.assign(roles_.size(), 0);
    for (std::size_t e = 0; e < roles_.size(); ++e)
      barred_[e] = isBetween(e) && linked[sz(problem_.edges[e].from)] != linked[sz(problem_.edges[e].to)];
  }

  // Joins parts that enough closures agree on, and bars all closures between others.
  void link() {
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
      for (std::size_t e = 0; e < tried.size(); ++e) tried[e] |= weighed_.back().second[e];
    }
  }

  // Joins two parts where the closures that then agree are evidence enough, as a whole. Returns whether they are.
  bool tryLink(int closure) {
    const Problem<D> before = proposed_;
    addLink(closure);
    barUnlinked();
    if (propose({}, {}, false, true)) return true;
    proposed_ = before;
    proposed_roles_.pop_back();
    barUnlinked();
    return false;
  }

  struct Considered {
    std::vector<char> witnessed, thinned;  // by edge
  };

  // The closures inside, and those outside that agree with another one near them: all of these, or one in kRow.
  Considered considerWitnessed(const Problem<D>& scaled) const {
    std::vector<int> candidates;
    for (std::size_t e = 0; e < proposed_roles_.size(); ++e)
      if (proposed_roles_[e] == EdgeRole::Candidate) candidates.push_back(static_cast<int>(e));
    const DeadReckoning<D> reckoning(scaled, proposed_roles_);
    const std::vector<int> group = consistentGroups(scaled.edges.size(), ClosureLoops<D>(scaled, candidates, reckoning),
                                                    1.0, Thresholds(candidates.size(), kTangentSize<D>));
    std::vector<int> members(scaled.edges.size(), 0);
    for (const int e : candidates) ++members[sz(group[sz(e)])];
    Considered made{best_.hypothesis.in, {}};
    made.witnessed.resize(proposed_roles_.size(), 1);
    made.thinned = made.witnessed;
    std::vector<int> before(scaled.edges.size(), 0);
    for (const int e : candidates) {
      if (made.thinned[sz(e)] || members[sz(group[sz(e)])] < 2) continue;
      made.witnessed[sz(e)] = 1;
      made.thinned[sz(e)] = before[sz(group[sz(e)])]++ % kRow == 0;
    }
    return made;
  }

  // Looks for slips where variances are those of the best set, and proposes what follows, with these factors.
  void heal(const VarianceFactors& factors) {
    const Problem<D> scaled = withFactors(proposed_, proposed_roles_, best_.hypothesis.factors);
    std::vector<char> in = best_.hypothesis.in;
    in.resize(proposed_roles_.size(), 1);
    if (rejected(best_.assessed) == 0 && !maySlip(scaled, proposed_roles_, in, in, best_.hypothesis.poses)) return;
    Considered some = considerWitnessed(scaled);
    std::vector<char> considered = std::move(some.witnessed), all(scaled.edges.size(), 1);
    const AcceptedGraph<D> graph(scaled);
    if (graph.work(all, true) <= kWork * graph.work(considered, true)) considered = std::move(all);
    else if (!maySlip(scaled, proposed_roles_, in, considered, best_.hypothesis.poses)) return;
    // Rows of false closures between far places would fill the factor.
    if (graph.work(considered, true) > kWork * graph.work(in, true)) considered = std::move(some.thinned);
    if (proposeWithoutSlips(findSlips(scaled, proposed_roles_, considered, {}, odometry_.poses), factors)) return;
    // From odometry as it is, a slip that closures nearby seem to bear out is not found. What is no more than chance
    // refutes nothing.
    if (evidence() < kDecisive) return;
    const std::vector<char> doubted = mostRefuted(scaled, proposed_roles_, in, considered);
    if (!doubted.empty())
      proposeWithoutSlips(findSlips(scaled, proposed_roles_, considered, doubted, odometry_.poses), factors);
  }

  // Proposes what follows where these steps are what the closures say. Returns whether it is better.
  bool proposeWithoutSlips(std::vector<Slip<D>> slips, const VarianceFactors& factors) {
    slips.erase(std::remove_if(slips.begin(), slips.end(),
                               [&](const Slip<D>& slip) { return slip.edge >= static_cast<int>(roles_.size()); }),
                slips.end());
    if (slips.empty()) return false;
    slips_ = std::move(slips);
    const Problem<D> before = proposed_;
    for (const Slip<D>& slip : slips_) {
      proposed_.edges[sz(slip.edge)].Z = slip.T_from_to;
      proposed_.edges[sz(slip.edge)].information *= kHealedShare;
    }
    if (propose(factors, slips_)) return true;
    proposed_ = before;
    slips_.clear();
    return false;
  }

  void rescale() {
    if (!isContested(best_.assessed) && !best_.hypothesis.factors.areBeyond(kContestedFactor)) return;
    const auto try_with = [&](const VarianceFactors& factors) {
      if (!takesNearlyAll() && factors.odometry <= evaluator_->largestOdometryFactor()) propose(factors, slips_);
    };
    const bool looser = evidence() < kDecisive || mayFitLooser();
    if (looser) try_with({kFar, kFar});  // what is too sure of itself shuts true ones out
    if (!isCredible()) {
      if (looser) try_with({kFar, 1.0});
      if (looser) try_with({1.0, kFar});
      try_with({1.0 / kFar, 1.0 / kFar});
    }
    regrow();
    // Where variances were stated too large, a slip stands out only now.
    if (slips_.empty() && evidence() >= kDecisive && !best_.grown_with.areWithin(kRegrowFactor, {}))
      heal(best_.grown_with);
  }

  // Whether the best set explains far more than chance, with variances near those stated.
  bool isCredible() const { return evidence() >= kDecisive && !best_.hypothesis.factors.areBeyond(kContestedFactor); }

  // Whether more than a few of the rejected closures would fit the best set with variances kFar times larger than those
  // stated, or than those that follow from it if they are smaller. Where they would not, and the set explains more than
  // chance, no others can be gained by that.
  bool mayFitLooser() const {
    const Thresholds thresholds(candidates_, kTangentSize<D>);
    const VarianceFactors& found = best_.hypothesis.factors;
    const double far = kFar * std::min(1.0, std::max(found.odometry, found.closures));
    std::size_t near = 0;
    for (const EdgeAssessment& edge : best_.assessed.edges)
      near += edge.verdict == urban_nav_core::ClosureVerdict::Rejected &&
              edge.chi2 <= far * thresholds.limit[sz(std::max(1, edge.dof))];
    return static_cast<double>(near) > kContestedShare * static_cast<double>(candidates_);
  }

  // Whether the best set was found with the variances that follow from it, or none better was.
  bool isSettled() const {
    const VarianceFactors& now = best_.hypothesis.factors;
    return now.areWithin(kRegrowFactor, best_.grown_with) || now.areWithin(kRegrowFactor, regrown_with_);
  }

  void regrow() {
    for (int i = 0; i < kRegrows && !isSettled(); ++i) {
      const VarianceFactors now = best_.hypothesis.factors;
      regrown_with_ = now;
      if (!propose(now, slips_)) return;
    }
  }

  const Problem<D>& problem_;
  const std::vector<EdgeRole>& roles_;
  Problem<D> proposed_;  // with what takes the place of slips and of steps between sessions
  std::vector<EdgeRole> proposed_roles_;
  std::size_t candidates_ = 0, between_ = 0;
  std::vector<int> parts_;    // by pose, what odometry holds together
  std::vector<char> barred_;  // by edge: joins parts that too few closures agree on
  bool contested_ = false, unweighed_ = false;
  std::optional<Judgement<D>> unopposed_;
  std::optional<CoreGraph<D>> core_;  // of a graph beyond kMostPoses
  std::unique_ptr<HypothesisEvaluator<D>> evaluator_;
  Hypothesis<D> odometry_;
  Proposal best_;
  VarianceFactors regrown_with_;
  std::vector<std::pair<double, std::vector<char>>> weighed_;  // evidence of each set, and what is in it
  std::vector<Slip<D>> slips_;
};

}  // namespace pose_graph
