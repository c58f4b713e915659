// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibration/calibration_terms.hpp"
#include "mounted_laser.hpp"

namespace laser_mapper {

/// Plausible size of an error of each term: standard deviations of the prior, s, m and rad.
TermVector priorSigmas();

/// Gaussian of the terms of all lasers, 7 each.
struct TermEstimate {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd conditional_sigma;  ///< of each term if all others were known

  double sigma(Eigen::Index term) const { return std::sqrt(covariance(term, term)); }
  /// Returns whether the measurements say more about a term than the prior.
  bool isConstrained(Eigen::Index term) const;
};

/// Returns which terms differ from zero beyond chance. Delay, shift and turn of each laser are chosen or dropped as
/// wholes: the least significant one is set to zero until all others are significant at 99.9 %.
std::vector<bool> significantTerms(const TermEstimate& estimate);

/// Returns the terms that are not constrained, in words.
std::vector<std::string> describeUnconstrained(const TermEstimate& estimate, const std::vector<MountedLaser>& lasers);

}  // namespace laser_mapper
