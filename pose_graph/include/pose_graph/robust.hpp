// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/solution.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace pose_graph {

/// What may happen to an edge.
enum class EdgeRole {
  Trusted,    ///< odometry: never weighted down, and yields where closures agree on something else
  Asserted,   ///< said by a person: never weighted down
  Candidate,  ///< a closure: accepted or rejected
};

/// Roles where it is not stated which edges are odometry: the first edge between two consecutive numbers, either way,
/// is Trusted, all others are Candidate. A graph without any edge between consecutive numbers trusts those that reach a
/// pose for the first time, in the order of its edges.
template <int D>
std::vector<EdgeRole> rolesByNumbers(const Problem<D>& problem);

enum class Reason {
  Role,         ///< Trusted or Asserted
  Fits,         ///< agrees with all that is accepted
  Disagrees,    ///< with what is accepted, by more than chance and noise explain
  Unconfirmed,  ///< could be, but so much could be there that fitting proves nothing, and no other closure supports it
  NoWitness,    ///< would join two parts of the graph that nothing else joins
  Slipped,      ///< a step of odometry that all else contradicts
  Undecided,    ///< agrees with others, but a set without it is nearly as likely, or odometry alone
};
/// A sentence.
const char* toString(Reason reason);

/// What robust selection makes of one edge.
struct EdgeAssessment {
  double weight = 1.0;  ///< 0 where rejected
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Accepted;
  Reason reason = Reason::Role;
  double chi2 =
      0.0;      ///< of a candidate against all other accepted edges together; of others, what remains of their own
  int dof = 0;  ///< directions that the edge measures
  std::vector<int> contradicted_by;  ///< of an asserted edge: edges that cannot be true beside it, the worst first
};

/// How a selection among several sets of edges ended.
struct SelectionReport {
  bool contested = false;  ///< whether more sets than one and odometry alone were weighed
  bool unweighed = false;  ///< the graph is too large for that, and closures were rejected or variances are far off
  bool undecided = false;  ///< no set of closures is likelier than chance: odometry alone
  /// Another set, with other closures, is likelier than a thousandth of the chosen one: what is not in both is left
  /// out.
  bool has_rival = false;
  double log_evidence = 0.0;         ///< of the set that was chosen, over odometry alone
  std::size_t undecided_priors = 0;  ///< FalsePriors::undecided, where the graph is of a file
  /// Factors of the variances that the information states, of the chosen set; 1 in large graphs that nothing contests.
  double odometry_factor = 1.0, closure_factor = 1.0;
  /// Whether the poses are those of the information put right: the factors differ from each other by more than 9, and
  /// are likelier than the variances stated by a factor of 1000. Not where the set has a rival.
  bool rescaled = false;
};

template <int D>
struct RobustSolution {
  Solution<D> solution;
  std::vector<EdgeAssessment> edges;
  /// By how much the squares of the residuals differ from what the edges' information promises: below 1 it is too
  /// modest. Above 1 it boasts, and many loops of near closures say so; where there are none, it is taken at its word.
  double variance_factor = 1.0;
  SelectionReport selection;  ///< of relaxSelected()
};

/// Relaxes a graph some of whose closures are false, without any setting. `roles`: one for each edge. Derivation:
/// docs/derivations/pose_graph.md.
///
/// What the information is worth is read off loops of two near closures first. Where next to nothing speaks against
/// odometry all closures are taken at once, and that is the answer if they fit. Else they grow into the graph by
/// evidence: against what is accepted so far each one is tested by its innovation, with the covariance that the
/// accepted graph gives; evidence is the logarithm of how much likelier its residual is from a true closure than from
/// one anywhere in the map. The better half of those that pass enters, the graph is relaxed, and everything is judged
/// anew: what entered wrongly leaves again by Baarda's test of one observation, or of one common bias of a group (A
/// testing procedure for use in geodetic networks, 1968). At the end all are judged once more where the graph is
/// settled, so that a group which bends a long way until it fits shows too. Where information is too modest, a closure
/// that fits by what it states and is far likelier true than anywhere stays. Covariances are those of random
/// disturbances of all edges carried through the factor, some dozens of right-hand sides; so a thousand closures cost
/// what one costs. Where odometry promises more than it keeps and closures are left out because of that, a second
/// minimisation with truncated squares starts from there (Yang, Antonante, Tzoumas, Carlone, Graduated non-convexity,
/// RA-L 2020) and is taken if its truncated cost is lower and more closures fit.
///
/// Parts that no trusted edge joins are joined where at least two closures agree with each other. The result does not
/// depend on the number of threads. The problem must be sound (check.hpp).
template <int D>
RobustSolution<D> relaxRobust(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                              const SolveOptions& options);

/// relaxRobust() and, where that rejects many closures, finds the information far off or sees several sessions, its
/// alternatives: the same with the information of odometry or of closures scaled, with steps of odometry that slipped
/// taken out, and with sessions joined by closures that agree with each other, two of different rows at least and more
/// than chance explains, or by all closures where none disagrees, which is a rival if they are only two. The set with
/// the largest evidence wins (robust/decision/score.hpp), and odometry alone competes with all of them: where no set is
/// likelier by a factor of 1000, no closure is accepted. Of a set that another one comes near by that factor, what both
/// have is accepted. Edges that are the same to the last bit count once. Where the variances of odometry and closures
/// are off by more than a factor of 9 against each other, by evidence, the poses are those of the information put
/// right. Of graphs beyond 200 000 poses the selection of relaxRobust() alone is weighed against odometry, by the core
/// that their chains leave, or not at all where it is as large (SelectionReport::unweighed).
template <int D>
RobustSolution<D> relaxSelected(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const SolveOptions& options);

}  // namespace pose_graph
