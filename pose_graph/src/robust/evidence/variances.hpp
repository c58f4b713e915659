// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"
#include "robust/evidence/closure_evidence.hpp"
#include "robust/evidence/closure_loops.hpp"

namespace pose_graph {

/// Prior of the deviations of edges: one standard deviation is this factor relative to the stated ones.
constexpr double kStatedWithin = 3.0;
/// Variance factor beyond which a set of edges is contested.
constexpr double kContestedFactor = kStatedWithin * kStatedWithin;
/// Variance factor of ten deviations, which errors do not reach if stated correctly.
constexpr double kFarFactor = 100.0;

/// Returns whether `factor` is above `limit` or below its inverse.
inline bool beyond(double factor, double limit) { return factor > limit || factor < 1.0 / limit; }

/// Factors of the stated variances: of odometry (Trusted, Asserted) and of closures (Candidate).
struct VarianceFactors {
  double odometry = 1.0, closures = 1.0;

  /// Returns whether at least one factor is beyond `limit`.
  bool areBeyond(double limit) const { return beyond(odometry, limit) || beyond(closures, limit); }
  /// Returns whether both ratios to the factors of `other` are within `limit`.
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

/// Weighted squared residuals and their redundancy, the number of independent residuals.
struct VarianceComponent {
  double squares = 0.0, redundancy = 0.0;
};
/// First index: odometry (0) and closures (1); second index: translation and rotation.
struct VarianceComponents {
  VarianceComponent of[2][2];
};

/// Computes the variance components. `weights`: per edge, the inverse of the current factor of its group; 0 excludes
/// the edge. If translation and rotation are correlated, their common part counts in both.
template <int D>
VarianceComponents varianceComponents(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                      const std::vector<double>& weights, const std::vector<Rigid<D>>& poses);

/// Returns the variance factor that maximises the posterior of a component. Prior: one standard deviation of its
/// logarithm is a factor of 3 on the deviations.
double likeliestFactor(const VarianceComponent& component);
/// Returns the log of that prior, without its constant.
double logPriorOfFactor(double factor);

/// Returns the variance of unit weight of the edges inside, with each square clipped at its limit. The value expected
/// from `scale` (InformationScale::factor) enters with the weight of ten observed tangents, so that a few redundant
/// edges do not dominate. `scale` also contains false closures that agree with each other, hence it is no lower bound.
template <int D>
double varianceFactor(const ClosureEvaluator<D>& evaluator, const std::vector<char>& in,
                      const std::vector<Rigid<D>>& poses, int unknowns, const Thresholds& thresholds, double scale);

}  // namespace pose_graph
