// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "robust/evidence/closure_loops.hpp"
#include "robust/evidence/variances.hpp"
#include "solve/relaxed_set.hpp"

namespace pose_graph {

/// Logarithm of the Bayes factor that a set of closures needs over odometry alone, and over another set to be decided:
/// a factor of 1000, "decisive" by Jeffreys, Theory of Probability, 1961.
constexpr double kDecisive = 7.0;

/// Factor of variances; less changes hardly a verdict.
constexpr double kSameFactor = 1.4;

/// A set of edges that may be the true ones, with what it explains.
template <int D>
struct Hypothesis {
  std::vector<char> in;  ///< by edge: not 0 for those taken as true
  std::vector<Rigid<D>> poses;
  VarianceFactors factors;
  double log_inside = 0.0;      ///< the part of the evidence that is of the edges inside
  double log_evidence = 0.0;    ///< all of it
  double by_contraction = 0.0;  ///< HypothesisEvaluator::gainByContraction()
};

/// Scores sets of edges of one graph by their evidence: the density of all measurements, with the poses integrated out
/// around the minimum (Laplace's approximation; MacKay, Neural Computation 1992). An edge outside has the density of
/// chance: anywhere within what odometry can have reached, and any heading; a closure outside whose neighbour is
/// outside too may err like that one, as places that look alike do. The number of closures inside is a priori any, and
/// which they are as well, so that a set is worth only what it explains beyond the choice of it; of neighbours the
/// choice is one of how often true and false ones alternate. Where the map that follows from a set makes agreement by
/// chance likelier than the odometry does, the set explains that much less beside odometry alone: any closures agree
/// with a map drawn together to a few places.
template <int D>
class HypothesisEvaluator {
 public:
  HypothesisEvaluator(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  /// Relaxes the edges that are in from `hypothesis.poses`, estimates the factors and fills `log_evidence`. A trusted
  /// edge outside is a slip, and costs what the rarity of slips says.
  void evaluate(Hypothesis<D>& hypothesis) const;

  /// Logarithm of how much likelier the estimated factors of a hypothesis are than the variances that the information
  /// states; near zero where a few closures determine the factors.
  double gainByFactors(const Hypothesis<D>& hypothesis) const;

  /// The largest factor that steps of odometry allow: where errors are independent from step to step, half the square
  /// of the difference of two successive steps bounds the variance of one, as the motion only adds to it; the middle
  /// one of all, times 100 for errors that are not independent, and 100 at least.
  double largestOdometryFactor() const { return largest_odometry_; }

  /// By how much closures inside agree by chance rather on the map of the hypothesis than on that of odometry, which is
  /// no evidence for them: closures are found where two places are alike, so that the density of one that is true is
  /// relative to how often two poses of the map lie as it says, over the volume within which the set as a whole
  /// predicts those that rows begin with; what follows in a row is found because of these. Requires evaluate(); not
  /// less than 0. None where closures are assertions: they are found with
  /// odometry as tight as it says, which draws no map together.
  double gainByContraction(const Hypothesis<D>& hypothesis) const;

  /// Whether most closures state one and the same, as those do that say "the same place" and measure nothing. They
  /// agree with each other exactly, all the more the looser odometry is: variances that follow from them serve to score
  /// one set, not to find another or to relax with.
  bool areAssertions() const { return assertions_; }

  /// Returns closureRows(), by edge.
  const std::vector<int>& rows() const { return row_; }

  /// How many rows of neighbouring closures are inside: closures of one row are no independent witnesses.
  double rowsInside(const Hypothesis<D>& hypothesis) const;

  /// Rows of closures inside that alone span some step between consecutive poses: no other closure confirms them, and
  /// without one the map moves to where odometry leads. At most eight, those first that span most steps alone.
  std::vector<std::vector<int>> unconfirmedRows(const Hypothesis<D>& hypothesis) const;

  /// An evaluated hypothesis with one closure of each row (of thirty) alone, and the factors that follow from these:
  /// over a long distance odometry may err by more than it states where it errs by less from one closure of a row to
  /// the next, and the many of a row hide it.
  /// The factors are estimated in so many rounds; none: they are those of the hypothesis.
  Hypothesis<D> assessRows(const Hypothesis<D>& hypothesis, int rounds) const;
  static constexpr int kRounds = 10;

  /// Logarithms of the factors by which a set that assessRows() assessed is less likely without each of these rows of
  /// its closures, linearised where it is relaxed; minus infinity where that is no estimate: rows of more than thirty,
  /// and those that alone hold parts together.
  std::vector<double> estimateLosses(const Hypothesis<D>& rows, const Hypothesis<D>& hypothesis,
                                     const std::vector<std::vector<int>>& without) const;

  /// Closures outside a set, by edge, in whose row more are inside: that it is one place is not in question.
  std::vector<char> outsideAcceptedRows(const std::vector<char>& in) const;

  /// Whether larger variances may gain a set that is likelier than an evaluated one, `edges` what was made of each:
  /// with the nearest rows outside, of any number, the factor of all variances is larger, which those inside pay for. A
  /// row costs what its nearest closure does where the set is relaxed, and is worth no more than its density were it
  /// predicted exactly.
  bool mayFitLooser(const Hypothesis<D>& hypothesis, const std::vector<EdgeAssessment>& edges) const;

  /// Whether some pose is elsewhere by more than a hundredth of the map's extent.
  bool isDisplaced(const std::vector<Rigid<D>>& poses, const std::vector<Rigid<D>>& others) const;

  /// Only trusted and asserted edges, evaluated. To be called before any other is evaluated.
  Hypothesis<D> evaluateOdometry();

 private:
  // Relaxes, estimates the factors in so many rounds at most, and fills `log_evidence`.
  void assess(Hypothesis<D>& hypothesis, int rounds) const;
  double chance(const Hypothesis<D>& hypothesis) const;
  // Whether a closure agrees with the one before it in its row rather than by chance.
  bool isFollower(int e) const {
    const std::size_t i = static_cast<std::size_t>(e);
    return neighbour_[i] >= 0 && log_alike_[i] > log_false_[i];
  }
  // Estimates both factors anew where the set is relaxed and factored.
  VarianceFactors estimateFactors(const Hypothesis<D>& hypothesis) const;
  // Logarithm of how much likelier than by chance a closure may be, with this factor of its variances.
  double mostWorth(std::size_t closure, double factor) const;
  // Logarithm of the densities of closures that follow another one in their row, given the one before.
  double followersInside(const Hypothesis<D>& hypothesis) const;

  Problem<D> problem_;  // what an edge does not measure lies within the map; poses fixed by odometry alone are free
  const std::vector<EdgeRole>& roles_;
  DeadReckoning<D> reckoning_;
  std::vector<int> candidates_;
  std::unique_ptr<RelaxedSet<D>> set_;
  double largest_odometry_ = 1.0;
  bool assertions_ = false;
  double log_odometry_ = 0.0;      ///< log_inside of odometry alone
  double log_place_ = 0.0;         ///< of one pose anywhere, density
  std::vector<double> log_false_;  ///< by edge, density of its measurement were it anywhere
  std::vector<int> neighbour_;     ///< by edge: a closure near it, before it; -1 without one
  std::vector<double> log_alike_;  ///< by edge, density of its measurement were it to err like its neighbour; minus
                                   ///< infinity for one that would not, as the row is too long
  std::vector<int> row_;
};

extern template class HypothesisEvaluator<2>;
extern template class HypothesisEvaluator<3>;

}  // namespace pose_graph
