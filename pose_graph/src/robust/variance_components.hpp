// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

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

}  // namespace pose_graph
