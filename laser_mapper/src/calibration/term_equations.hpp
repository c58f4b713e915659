// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/term_selection.hpp"

namespace laser_mapper {

/// Normal equations of the terms of some devices, 7 each, with all other unknowns eliminated.
struct TermEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;  ///< information * change = gradient
  Eigen::MatrixXd scatter;   ///< of the gradients of the places: larger than `information` if errors within a place are
                             ///< correlated
  std::size_t patches = 0;

  TermEquations& operator+=(const TermEquations& other);
};
TermEquations zeroEquations(std::size_t devices);

/// Gauss-Newton step of the terms, with their Gaussian after it.
struct TermStep {
  Eigen::VectorXd change;
  TermEstimate estimate;
};

/// Solves the equations at `terms`, 7 per device, with a zero-mean prior of priorSigmas(). Terms that are not `wanted`
/// are fixed at zero. Variances are computed from the scatter of the places where that is larger. Returns nullopt if
/// the equations are not positive definite.
std::optional<TermStep> solveTerms(TermEquations equations, const Eigen::VectorXd& terms,
                                   const std::vector<bool>& wanted);

/// Returns whether a step is a small fraction of the standard deviations.
bool isConverged(const TermStep& step);

}  // namespace laser_mapper
