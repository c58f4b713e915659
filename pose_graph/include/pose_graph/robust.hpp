// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/solution.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace pose_graph {

/// Role of an edge in the selection.
enum class EdgeRole {
  Trusted,    ///< odometry: never weighted down; rejected only as a slip
  Asserted,   ///< stated by a user: never weighted down
  Candidate,  ///< closure: accepted or rejected
};

/// Returns roles for a graph that does not mark its odometry. The first edge between two consecutive numbers, in either
/// direction, is Trusted, all others are Candidate. If no edge joins consecutive numbers, the edges that first reach a
/// pose, in their order, are Trusted.
template <int D>
std::vector<EdgeRole> rolesByNumbers(const Problem<D>& problem);
/// Reason of the verdict on an edge.
enum class Reason {
  Role,         ///< Trusted or Asserted
  Fits,         ///< consistent with all accepted edges
  Disagrees,    ///< inconsistent with the accepted edges beyond noise
  Unconfirmed,  ///< consistent, but so weakly constrained that it proves nothing, and no other closure supports it
  NoWitness,    ///< would join two otherwise unconnected parts of the graph
  Slipped,      ///< a step of odometry contradicted by all other edges
  Undecided,    ///< consistent with other closures, but a set without it, or odometry only, is nearly as likely
};
/// Returns a sentence.
const char* toString(Reason reason);

/// Result of robust selection for one edge.
struct EdgeAssessment {
  double weight = 1.0;  ///< 0 if rejected
  urban_nav_core::ClosureVerdict verdict = urban_nav_core::ClosureVerdict::Accepted;
  Reason reason = Reason::Role;
  /// Candidates: with respect to all other accepted edges together. Other edges: of their own residual.
  double chi2 = 0.0;
  int dof = 0;                       ///< number of directions that the edge measures
  std::vector<int> contradicted_by;  ///< asserted edges: edges inconsistent with this one, the worst first
};

/// Result of the selection among sets of edges.
struct SelectionReport {
  bool contested = false;  ///< sets other than odometry only were compared
  /// The graph is too large to compare sets, and closures were rejected or variances are far off.
  bool unweighed = false;
  bool undecided = false;  ///< no set of closures is more likely than chance: odometry only
  /// Another set has more than a thousandth of the chosen set's likelihood, and closures that are not in both are not
  /// used; or odometry as stated contradicts accepted closures that no other closure confirms.
  bool has_rival = false;
  double log_evidence = 0.0;         ///< of the chosen set, relative to odometry only
  std::size_t undecided_priors = 0;  ///< FalsePriors::undecided, for a graph from a file
  /// Factors of the stated variances, estimated with the chosen set; 1 in large uncontested graphs.
  double odometry_factor = 1.0, closure_factor = 1.0;
  /// Whether the poses were relaxed with these factors: they differ from each other by more than 9 and are more likely
  /// than the stated variances by a factor of 1000. False if the set has a rival.
  bool rescaled = false;
};
/// Poses, edge assessments and variance factors of a robust relaxation.
template <int D>
struct RobustSolution {
  Solution<D> solution;
  std::vector<EdgeAssessment> edges;
  /// Ratio of observed to stated variance of the residuals. Below 1: information is too low. Above 1: information is
  /// overconfident, as estimated from many short loops; never above 1 without such loops.
  double variance_factor = 1.0;
  SelectionReport selection;  ///< of relaxSelected()
};

/// Relaxes a graph that contains false closures; there are no parameters. `roles`: one per edge. Derivation:
/// docs/derivations/pose_graph.md.
///
/// First, a common scale of the information matrices is estimated from loops of two near closures. If few candidates
/// contradict odometry, all closures are accepted at once, and the result is final if they are consistent. Otherwise
/// closures are admitted in rounds. Each candidate is tested by its innovation, with the covariance predicted from the
/// accepted graph. Its evidence is the log likelihood ratio of the residual for a true closure and for a uniformly
/// distributed one in the map. The better half of the candidates that pass is admitted, the graph is relaxed, and all
/// closures are tested again; wrong ones are removed by Baarda's test of one observation, or of a common bias of a
/// group (A testing procedure for use in geodetic networks, 1968). All closures are tested once more at the converged
/// solution, which reveals groups that only fit because they bend a long path. If the information is too low, a closure
/// that fits with its stated covariance and is far more likely true than random is kept.
///
/// Covariances are computed from random disturbances of all edges propagated through the factor, some dozens of
/// right-hand sides; the cost is independent of the number of closures. If odometry is overconfident and closures are
/// rejected because of that, a second minimisation with truncated squares starts from the result (Yang, Antonante,
/// Tzoumas, Carlone, Graduated non-convexity, RA-L 2020) and is used if its truncated cost is lower and more closures
/// fit.
///
/// Parts that are not joined by trusted edges are joined if at least two closures between them are consistent.
/// The result does not depend on the number of threads.
/// Requires: a well-formed problem (problem.hpp).
template <int D>
RobustSolution<D> relaxRobust(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                              const SolveOptions& options);

/// Runs relaxRobust(). If it rejects many closures, finds the information far off or joins several sessions,
/// alternatives are computed: the information of odometry or closures scaled; slipped steps of odometry removed;
/// sessions joined by consistent closures (at least two from different rows and more than chance explains) or by all
/// closures if none contradicts, which counts as a rival if there are only two. The set with the largest evidence is
/// chosen (robust/decision/score.hpp). Odometry only is one of the alternatives: if no set is more likely by a factor
/// of 1000, no closure is accepted. If another set is within that factor of the best one, the closures common to both
/// are accepted.
///
/// Bit-identical edges count once. If the variances of odometry and closures are off by more than a factor of 9 against
/// each other, by evidence, the poses are relaxed with corrected information. For more than 200 000 poses only the
/// result of relaxRobust() is compared with odometry, using the reduced graph of the chains, or no comparison is made
/// if that is too large (SelectionReport::unweighed).
template <int D>
RobustSolution<D> relaxSelected(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                const SolveOptions& options);

}  // namespace pose_graph
