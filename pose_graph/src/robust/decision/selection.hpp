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

/// Generates sets of edges and keeps the most likely one.
template <int D>
class Selection {
 public:
  Selection(const Problem<D>& problem, const std::vector<EdgeRole>& roles)
      : problem_(problem), roles_(roles), proposed_(problem), proposed_roles_(roles) {
    for (const EdgeRole role : roles) candidates_ += role == EdgeRole::Candidate;
  }

  void run();

  /// Returns whether sets of edges were scored against odometry only.
  bool wasScored() const { return evaluator_ != nullptr; }
  /// Returns whether sets other than the first one were compared.
  bool wasContested() const { return contested_; }
  /// Returns whether the best set is no more likely than chance, or fits only because variances were enlarged. An
  /// uncontested set is kept unless chance is decisively more likely.
  bool isUndecided() const;
  /// Solution with all closures, if some of them join sessions, none is rejected and none fits only because of enlarged
  /// variances; too few closures to be decisive over chance.
  const std::optional<SelectedEdges<D>>& unopposed() const { return unopposed_; }
  /// Returns by pose whether no closure of its odometry-connected part is rejected or leads to another part. Nowhere
  /// true if closures fit because variances were enlarged.
  std::vector<char> inUncontestedParts() const;
  /// Returns whether sets should have been compared but the graph is too large.
  bool isUnweighed() const { return unweighed_; }
  /// Rejects (as undecided) the closures of the best set that a nearly as likely set, a rival, does not contain. A slip
  /// whose ends are no longer joined by the rest becomes odometry again. Relaxes the poses. Returns whether there is a
  /// rival.
  bool keepShared();
  bool hasVariances() const { return evaluator_ && !evaluator_->areAssertions(); }
  /// Returns whether the variance factors of odometry and closures differ by far, with decisive evidence.
  bool isRescaled() const;
  bool isThinlyJoined() const { return between_ < kLeastWeakLink; }
  /// Returns whether a row of accepted closures that no other closure confirms contradicts odometry with its stated
  /// variances (HypothesisEvaluator::hasContradictedRow()).
  bool contradictsOdometry() const {
    return hasVariances() && !core_ && evaluator_->hasContradictedRow(best_.hypothesis);
  }
  bool rejectsAny() const { return rejected(best_.selected) > 0; }
  double evidence() const { return overOdometry(best_.hypothesis); }
  const Hypothesis<D>& odometryAlone() const { return odometry_; }
  const Hypothesis<D>& hypothesis() const { return best_.hypothesis; }
  SelectedEdges<D> take() { return std::move(best_.selected); }

 private:
  struct Proposal {
    SelectedEdges<D> selected;
    Hypothesis<D> hypothesis;
    std::vector<char> members;  // by edge: inside the hypothesis or added by readmit()
    std::vector<Slip<D>> slips;
    VarianceFactors found_with;
    std::optional<bool> is_contradicted;  // computed on demand
  };

  struct Scored {
    double log_evidence;
    std::vector<char> members;
    bool is_confirmed = true;  // holdsWithout() its slips
  };

  // Scores the sets that were compared with one closure per row (HypothesisEvaluator::assessRows()) and keeps the most
  // likely one, if it is decisive over odometry only.
  void decideByRows();

  // Edges common to the best set and all its rivals; empty if there is no rival.
  std::optional<std::vector<char>> findShared() const;

  // The best set with one closure per row (HypothesisEvaluator::assessRows()), with its own factors.
  const Hypothesis<D>& rowsAlone() const;

  // Removes from `shared` the edges that nearly as likely sets do not contain. Returns whether there are such sets. A
  // set refused for its slips, which one row of closures alone may have caused, is a rival that removes nothing.
  bool shareWithSets(std::vector<char>& shared) const;

  // Removes from `shared` each unconfirmed row of closures if the map without it differs and is nearly as likely.
  // Returns whether there are such rows.
  bool shareWithoutRows(std::vector<char>& shared) const;

  double overOdometry(const Hypothesis<D>& hypothesis) const {
    return hypothesis.log_evidence - hypothesis.collapse_penalty - odometry_.log_evidence;
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

  // Applies the collapse penalty (HypothesisEvaluator::collapsePenalty()) if it can change the decision.
  void applyCollapsePenalty(Hypothesis<D>& hypothesis) const {
    if (overOdometry(hypothesis) > 0.0) hypothesis.collapse_penalty = evaluator_->collapsePenalty(hypothesis);
  }

  // Whether a set fits only because variances were changed: each of its rows is then hardly more likely than chance.
  bool reliesOnInflatedVariance(const Hypothesis<D>& hypothesis) const;

  bool isBetween(std::size_t e) const {
    return roles_[e] == EdgeRole::Candidate && parts_[sz(problem_.edges[e].from)] != parts_[sz(problem_.edges[e].to)];
  }

  // Extends values by edge to the proposed graph, which has further edges for links between sessions.
  template <typename Value>
  std::vector<Value> proposedFrom(std::vector<Value> by_edge, typename std::vector<Value>::value_type others) const {
    by_edge.resize(proposed_roles_.size(), others);
    return by_edge;
  }

  // Runs the inner selection on the proposed graph without barred edges.
  SelectedEdges<D> selectProposed(const VarianceFactors& factors, double most_work) const;

  // Accepts closures that fit with their stated variances, where the proposed variances are smaller and led to their
  // rejection. Closures of an accepted row are accepted by the wider limit for removal, since the association of the
  // row's places is confirmed.
  void readmit(Proposal& proposal) const;
  // Accepts the closures of `some` (by edge) that fit with their own variances larger by the factor `own`.
  void readmit(Proposal& proposal, double own, const std::vector<char>& some) const;

  // Whether accepted edges connect both ends of each slip, even without any one row of closures; otherwise the step is
  // not contradicted, or only by one pair of similar places.
  bool holdsWithout(const SelectedEdges<D>& selected, const std::vector<Slip<D>>& slips) const;

  // Number of closures between parts that are inside but not in the best set.
  std::size_t countLinking(const Hypothesis<D>& hypothesis) const;

  // Work limit for a set, in block multiplications.
  double mostWork() const;

  // Scores the inner selection on the proposed graph with these factors and keeps the better set. Returns whether the
  // new set is kept.
  bool propose(const VarianceFactors& factors, const std::vector<Slip<D>>& slips, bool forced = false,
               bool is_doubtful_link = false);

  // Compares the only selection of a large graph with odometry, in its core graph.
  void evaluateReducedGraph();

  // Adds a closure between two parts as a trusted edge.
  void addLink(int closure);

  // Bars closures between parts that no link joins.
  void barUnlinked();

  // Joins parts by links of consistent closures, and bars all closures between other parts.
  void joinSessions();

  // Joins two parts by a closure if all closures consistent with it have sufficient total evidence. Returns whether
  // the parts were joined.
  bool tryLink(int closure);

  struct Considered {
    std::vector<char> confirmed, thinned;  // by edge
  };

  // The closures inside, and those outside confirmed by a near one: all of these, or one in kRow.
  Considered considerConfirmed(const Problem<D>& scaled) const;

  // Searches for slips with the variances of the best set, and proposes the result with these factors.
  void proposeSlips(const VarianceFactors& factors);

  // Proposes a selection with slipped steps replaced by the motion that closures imply. Returns whether it is better.
  bool proposeWithoutSlips(std::vector<Slip<D>> slips, const VarianceFactors& factors);

  void tryScales();

  // Whether the best set is decisive and self-consistent: no closure contradicts the rest with the variances estimated
  // from it and its own at least as stated (contradictsItself()). Decisive evidence over odometry only does not imply
  // this.
  bool agreesWithItself();
  // Whether the best set also contains almost all closures: other variances then yield no better set.
  bool isUnquestioned() { return !rejectsMany(best_.selected) && agreesWithItself(); }

  // Whether the best set is decisive with variances near the stated ones.
  bool isCredible() const { return evidence() >= kDecisive && !best_.hypothesis.factors.areBeyond(kContestedFactor); }

  // Whether the best set was found with its own variances, or a repetition with them found no better one.
  bool isSettled() const {
    const VarianceFactors& now = best_.hypothesis.factors;
    return now.areWithin(kSameFactor, best_.found_with) || now.areWithin(kSameFactor, repeated_with_);
  }

  // Whether the variances estimated from the best set are not larger than those it was found with. If it is
  // self-consistent, a repetition with these gains nothing, and rejects closures with errors as stated where most
  // errors are far smaller.
  bool isTighter() const {
    const VarianceFactors &now = best_.hypothesis.factors, &then = best_.found_with;
    return now.odometry <= then.odometry && now.closures <= then.closures;
  }

  void repeatWithFactors();

  const Problem<D>& problem_;
  const std::vector<EdgeRole>& roles_;
  Problem<D> proposed_;  // with replacements of slips and links between sessions
  std::vector<EdgeRole> proposed_roles_;
  std::size_t candidates_ = 0, between_ = 0;
  std::vector<int> parts_;    // by pose: part connected by odometry
  std::vector<char> barred_;  // by edge: joins parts without enough consistent closures
  bool contested_ = false, unweighed_ = false;
  std::optional<SelectedEdges<D>> unopposed_;
  std::optional<CoreGraph<D>> core_;  // of a graph of more than kMostPoses poses
  std::unique_ptr<HypothesisEvaluator<D>> evaluator_;
  Hypothesis<D> odometry_;
  Proposal best_;
  std::vector<Proposal> others_;                     // compared with the best set, without slips
  bool by_rows_ = false;                             // best_ has the evidence and the factors of decideByRows()
  mutable std::optional<Hypothesis<D>> rows_alone_;  // computed on demand
  VarianceFactors repeated_with_;
  std::vector<Scored> scored_;
  std::vector<Slip<D>> slips_;
};

extern template class Selection<2>;
extern template class Selection<3>;

}  // namespace pose_graph
