// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "condense/core_graph.hpp"
#include "linear/index.hpp"
#include "robust/decision/score.hpp"
#include "robust/generators/inner_selection.hpp"
#include "robust/generators/session_links.hpp"
#include "robust/generators/slips.hpp"

namespace pose_graph {

/// Proposes sets of edges, and keeps the best.
template <int D>
class Selection {
 public:
  Selection(const Problem<D>& problem, const std::vector<EdgeRole>& roles)
      : problem_(problem), roles_(roles), proposed_(problem), proposed_roles_(roles) {
    for (const EdgeRole role : roles) candidates_ += role == EdgeRole::Candidate;
  }

  void run();

  /// Whether sets of edges were scored against odometry alone.
  bool wasScored() const { return evaluator_ != nullptr; }
  /// Whether other sets than the first one were looked at.
  bool wasContested() const { return contested_; }
  /// Whether the best set is no likelier than chance, or fits because variances were enlarged until it did. A set that
  /// nothing contests remains unless chance is decidedly the likelier.
  bool isUndecided() const;
  /// Poses by all closures, where some join sessions, and none is rejected or fits because variances were enlarged: few
  /// closures outweigh no chance.
  const std::optional<SelectedEdges<D>>& unopposed() const { return unopposed_; }
  /// By pose, whether no closure of its part, which odometry holds together, is rejected or leads to another part. None
  /// where closures fit because variances were enlarged.
  std::vector<char> inUncontestedParts() const;
  /// Whether sets should have been weighed, and the graph is too large.
  bool isUnweighed() const { return unweighed_; }
  /// Rejects the closures of the best set that a rival, another set that is nearly as likely, does not share: they are
  /// undecided. Where the rest no longer joins the ends of a slip, the step is odometry again. The poses are relaxed
  /// anew. Returns whether there is a rival.
  bool keepShared();
  bool hasVariances() const { return evaluator_ && !evaluator_->areAssertions(); }
  /// Whether the variances of odometry and closures are off against each other by far, and that is no chance.
  bool isRescaled() const;
  bool isThinlyJoined() const { return between_ < kLeastWeakLink; }
  bool rejectsAny() const { return rejected(best_.selected) > 0; }
  double evidence() const { return overOdometry(best_.hypothesis); }
  const Hypothesis<D>& odometryAlone() const { return odometry_; }
  const Hypothesis<D>& hypothesis() const { return best_.hypothesis; }
  SelectedEdges<D> take() { return std::move(best_.selected); }

 private:
  struct Proposal {
    SelectedEdges<D> selected;
    Hypothesis<D> hypothesis;
    std::vector<char> members;  // by edge: those inside the hypothesis, and those that readmit() adds
    std::vector<Slip<D>> slips;
    VarianceFactors found_with;
    std::optional<bool> is_contradicted;  // once it was asked for
  };

  // Edges that the best set and all its rivals have; none where there is no rival.
  std::optional<std::vector<char>> findShared() const;

  // The best set by one closure of each row (HypothesisEvaluator::assessRows()), with its own factors.
  const Hypothesis<D>& rowsAlone() const;

  // Takes out of `shared` what sets nearly as likely have not. Returns whether there are any.
  bool shareWithSets(std::vector<char>& shared) const;

  // Takes out of `shared` each row of closures that no other confirms, where the map without it is another one, and
  // nearly as likely. Returns whether there are any.
  bool shareWithoutRows(std::vector<char>& shared) const;

  double overOdometry(const Hypothesis<D>& hypothesis) const {
    return hypothesis.log_evidence - hypothesis.by_contraction - odometry_.log_evidence;
  }
  bool isLoosened() const {
    const VarianceFactors& factors = best_.hypothesis.factors;
    return std::max({best_.selected.variance, factors.odometry, factors.closures}) > kContestedFactor;
  }
  std::ptrdiff_t rejected(const SelectedEdges<D>& selected) const;
  bool rejectsMany(const SelectedEdges<D>& selected) const {
    return static_cast<double>(rejected(selected)) > Thresholds::kContested * static_cast<double>(candidates_);
  }
  bool isContested(const SelectedEdges<D>& selected) const {
    return candidates_ > 0 && (rejectsMany(selected) || beyond(selected.variance, kContestedFactor));
  }
  Hypothesis<D> hypothesisOver(const SelectedEdges<D>& selected, const VarianceFactors& factors) const;

  // Takes off what is no evidence, where that decides anything.
  void contract(Hypothesis<D>& hypothesis) const {
    if (overOdometry(hypothesis) > 0.0) hypothesis.by_contraction = evaluator_->gainByContraction(hypothesis);
  }

  // Whether a set fits because variances were changed until it did: each row is then hardly likelier than chance.
  bool isInflated(const Hypothesis<D>& hypothesis) const;

  bool isBetween(std::size_t e) const {
    return roles_[e] == EdgeRole::Candidate && parts_[sz(problem_.edges[e].from)] != parts_[sz(problem_.edges[e].to)];
  }

  // The same by edge of the proposed graph, which has more: in place of steps between sessions.
  template <typename Value>
  std::vector<Value> proposedFrom(std::vector<Value> by_edge, typename std::vector<Value>::value_type others) const {
    by_edge.resize(proposed_roles_.size(), others);
    return by_edge;
  }

  // Inner selection over the proposed graph without what is barred.
  SelectedEdges<D> selectProposed(const VarianceFactors& factors, double most_work) const;

  // Accepts closures that err no more than they state, where the proposed variances are smaller than that: by these
  // they were rejected, which are not theirs. Those of an accepted row also by the test of what has to leave, which is
  // wider than that of what enters: their place is not in question.
  void readmit(Proposal& proposal) const;
  // Accepts those of `some` (by edge) that fit where their own variances are `own` times larger.
  void readmit(Proposal& proposal, double own, const std::vector<char>& some) const;

  // Whether accepted edges join the two ends of each slip, also without any one row of closures: where none do, the
  // step is not refuted, and one row is one place, which may resemble another one.
  bool holdsWithout(const SelectedEdges<D>& selected, const std::vector<Slip<D>>& slips) const;

  // Closures between parts that the best set has not.
  std::size_t countLinking(const Hypothesis<D>& hypothesis) const;

  // Beyond which a set is given up, in multiplications of blocks.
  double mostWork() const;

  // Scores the inner selection over the proposed graph with these factors, and keeps the better set. Returns whether it
  // is this one.
  bool propose(const VarianceFactors& factors, const std::vector<Slip<D>>& slips, bool forced = false,
               bool is_doubtful_link = false);

  // Weighs the one selection of a large graph against odometry alone, by its core.
  void weighCore();

  // Takes what a closure between two parts says as given.
  void addLink(int closure);

  // Bars closures between parts that no link joins.
  void barUnlinked();

  // Joins parts that enough closures agree on, and bars all closures between others.
  void joinSessions();

  // Joins two parts where the closures that then agree are evidence enough, as a whole. Returns whether they are.
  bool tryLink(int closure);

  struct Considered {
    std::vector<char> confirmed, thinned;  // by edge
  };

  // The closures inside, and those outside that agree with another one near them: all of these, or one in kRow.
  Considered considerConfirmed(const Problem<D>& scaled) const;

  // Looks for slips where variances are those of the best set, and proposes what follows, with these factors.
  void proposeSlips(const VarianceFactors& factors);

  // Proposes what follows where these steps are what the closures say. Returns whether it is better.
  bool proposeWithoutSlips(std::vector<Slip<D>> slips, const VarianceFactors& factors);

  void tryScales();

  // Whether the best set is decisive and no closure of it contradicts the rest where variances are those that follow
  // from it (contradictsItself()), and its own no less than stated. That it is likelier than odometry alone is not
  // enough.
  bool agreesWithItself();
  // Whether it takes nearly all closures, too: no other variances find a likelier set.
  bool isUnquestioned() { return !rejectsMany(best_.selected) && agreesWithItself(); }

  // Whether the best set explains far more than chance, with variances near those stated.
  bool isCredible() const { return evidence() >= kDecisive && !best_.hypothesis.factors.areBeyond(kContestedFactor); }

  // Whether the best set was found with the variances that follow from it, or none better was.
  bool isSettled() const {
    const VarianceFactors& now = best_.hypothesis.factors;
    return now.areWithin(kSameFactor, best_.found_with) || now.areWithin(kSameFactor, repeated_with_);
  }

  // Whether the variances that follow from the best set are no larger than those it was found with. Where it agrees
  // with itself, another selection with these gains none, and loses those that err as stated where most err by far
  // less.
  bool isTighter() const {
    const VarianceFactors &now = best_.hypothesis.factors, &then = best_.found_with;
    return now.odometry <= then.odometry && now.closures <= then.closures;
  }

  void repeatWithFactors();

  const Problem<D>& problem_;
  const std::vector<EdgeRole>& roles_;
  Problem<D> proposed_;  // with what takes the place of slips and of steps between sessions
  std::vector<EdgeRole> proposed_roles_;
  std::size_t candidates_ = 0, between_ = 0;
  std::vector<int> parts_;    // by pose, what odometry holds together
  std::vector<char> barred_;  // by edge: joins parts that too few closures agree on
  bool contested_ = false, unweighed_ = false;
  std::optional<SelectedEdges<D>> unopposed_;
  std::optional<CoreGraph<D>> core_;  // of a graph beyond kMostPoses
  std::unique_ptr<HypothesisEvaluator<D>> evaluator_;
  Hypothesis<D> odometry_;
  Proposal best_;
  mutable std::optional<Hypothesis<D>> rows_alone_;  // once it was asked for
  VarianceFactors repeated_with_;
  std::vector<std::pair<double, std::vector<char>>> weighed_;  // evidence of each set, and its members
  std::vector<Slip<D>> slips_;
};

extern template class Selection<2>;
extern template class Selection<3>;

}  // namespace pose_graph
