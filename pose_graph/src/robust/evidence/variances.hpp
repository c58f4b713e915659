// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"
#include "robust/evidence/closure_evidence.hpp"
#include "robust/evidence/closure_loops.hpp"

namespace pose_graph {

/// The deviations of edges are within that factor of what their information states: one standard deviation a priori.
constexpr double kStatedWithin = 3.0;
/// Of variances; a set whose factors are beyond is contested.
constexpr double kContestedFactor = kStatedWithin * kStatedWithin;
/// Of variances: ten deviations, which errors as they are stated do not reach.
constexpr double kFarFactor = 100.0;

/// Whether a factor is larger or smaller than 1 by more than that.
inline bool beyond(double factor, double limit) { return factor > limit || factor < 1.0 / limit; }

/// Factors of the variances that the information states: of edges along which the robot moved (Trusted, Asserted) and
/// of closures (Candidate).
struct VarianceFactors {
  double odometry = 1.0, closures = 1.0;

  /// Whether one of them is off by more than that.
  bool areBeyond(double limit) const { return beyond(odometry, limit) || beyond(closures, limit); }
  /// Whether they differ from others by less than that.
  bool areWithin(double limit, const VarianceFactors& other) const {
    return !beyond(odometry / other.odometry, limit) && !beyond(closures / other.closures, limit);
  }
};

/// Divides the information of each edge by its factor.
template <int D>
Problem<D> withFactors(Problem<D> problem, const std::vector<EdgeRole>& roles, const VarianceFactors& factors) {
  for (std::size_t e = 0; e < roles.size(); ++e)
    problem.edges[e].information /= roles[e] == EdgeRole::Candidate ? factors.closures : factors.odometry;
  return problem;
}

/// Squares of residuals, as the information weighs them, and their redundancy: the number of independent ones.
struct VarianceComponent {
  double squares = 0.0, redundancy = 0.0;
};
/// Of odometry and closures (first index 0, 1) in translation and rotation (second index).
struct VarianceComponents {
  VarianceComponent of[2][2];
};

/// `weights`: of each edge, the inverse of the factor that its group has so far; 0 leaves it out. Where translation and
/// rotation are correlated, what they share counts in both.
template <int D>
VarianceComponents varianceComponents(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                      const std::vector<double>& weights, const std::vector<Rigid<D>>& poses);

/// The most likely factor of variances given a component and a prior: the deviations are within a factor of 3 of what
/// is stated (one standard deviation of the logarithm).
double likeliestFactor(const VarianceComponent& component);
/// Logarithm of that prior, without its constant.
double logPriorOfFactor(double factor);

/// Variance of unit weight of the edges that are in, each counted no further than its limit. Starts from what is
/// expected by `scale` (InformationScale::factor) with the weight of ten observed tangents, so that a few redundant
/// edges do not decide; false ones that agree with each other are in `scale` too, so that it is no bound from below.
template <int D>
double varianceFactor(const ClosureEvaluator<D>& evaluator, const std::vector<char>& in,
                      const std::vector<Rigid<D>>& poses, int unknowns, const Thresholds& thresholds, double scale);

}  // namespace pose_graph
