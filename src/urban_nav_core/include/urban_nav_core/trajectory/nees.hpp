// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "urban_nav_core/trajectory/chi_square.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Returns the normalised estimation error squared, d^T covariance^-1 d with truth = boxPlus(estimate, d). Its mean is
/// 6 for a consistent covariance and larger for an optimistic one. Empty if the covariance is not positive definite.
std::optional<double> nees(const Pose& truth, const PoseWithCovariance& estimate);
/// Return the NEES of the translation or the rotation only (3 degrees of freedom).
std::optional<double> neesTranslation(const Pose& truth, const PoseWithCovariance& estimate);
std::optional<double> neesRotation(const Pose& truth, const PoseWithCovariance& estimate);

/// Mean NEES of estimates of T_first_body, in the axes of the first pose: both trajectories are taken relative to their
/// first pose. Poses without a positive definite covariance (such as the first, by definition) are omitted and counted.
struct NeesSummary {
  double mean = 0.0, mean_translation = 0.0, mean_rotation = 0.0;  ///< expected 6, 3, 3
  std::size_t count = 0, left_out = 0;
  /// 99 % interval of `mean` for independent errors. Errors along one trajectory are correlated, which makes it too
  /// narrow: a mean inside is evidence of consistency, one outside is not evidence against it.
  Band band;
};
NeesSummary neesOfTrajectory(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                             const std::vector<Matrix6d>& covariances);

}  // namespace urban_nav_core
