// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "urban_nav_core/trajectory/chi_square.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Normalised estimation error squared, d^T covariance^-1 d with truth = boxPlus(estimate, d): on average 6 where the
/// covariance tells the truth, more where it is too small. Empty where the covariance is not positive definite.
std::optional<double> nees(const Pose& truth, const PoseWithCovariance& estimate);
/// The same of the translation (3 degrees of freedom) and of the rotation alone.
std::optional<double> neesTranslation(const Pose& truth, const PoseWithCovariance& estimate);
std::optional<double> neesRotation(const Pose& truth, const PoseWithCovariance& estimate);

/// Mean NEES of estimates of T_first_body, in the axes of the first pose, against the truth: both trajectories are
/// taken relative to their first pose. Poses without a proper covariance (the first has none by definition) are left
/// out and counted.
struct NeesSummary {
  double mean = 0.0, mean_translation = 0.0, mean_rotation = 0.0;  ///< expected 6, 3, 3
  std::size_t count = 0, left_out = 0;
  /// 99 % band of `mean` if the errors of all poses were independent. Those of one trajectory are not: it is too narrow
  /// then, and a mean inside is good news, one outside not yet bad.
  Band band;
};
NeesSummary neesOfTrajectory(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                             const std::vector<Matrix6d>& covariances);

}  // namespace urban_nav_core
