// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/term_selection.hpp"

namespace laser_mapper {

/// Normal equations of the terms of some devices, 7 each, from which everything else is eliminated.
struct TermEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;  ///< information * change = gradient
  Eigen::MatrixXd scatter;   ///< of the gradients of the places: larger than `information` where errors of a place are
                             ///< correlated
  std::size_t patches = 0;

  TermEquations& operator+=(const TermEquations& other);
};
TermEquations zeroEquations(std::size_t devices);

/// A Gauss-Newton step of the terms, and their Gaussian after it.
struct TermStep {
  Eigen::VectorXd change;
  TermEstimate estimate;
};

/// Solves the equations at `terms`, 7 for each device, with the prior that they are zero within priorSigmas(). Terms
/// that are not `wanted` are zero and stay so. A variance is that by the scatter of the places where it is larger.
/// Returns nullopt if the equations are not positive definite.
std::optional<TermStep> solveTerms(TermEquations equations, const Eigen::VectorXd& terms,
                                   const std::vector<bool>& wanted);

/// Returns whether a step is a small part of the standard deviations.
bool isConverged(const TermStep& step);

}  // namespace laser_mapper
