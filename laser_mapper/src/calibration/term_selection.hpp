// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
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

/// What an estimate of the terms of some devices comes down to.
struct TermSelection {
  TermEstimate all;               ///< of all terms
  TermEstimate chosen;            ///< of those that are significant, the others zero
  std::vector<bool> significant;  ///< of them: differ from zero beyond chance, and are observable beside each other

  bool holdsAny() const;
  /// Returns the terms of a device, of which the significant ones are adopted if `is_adopted`.
  DeviceCalibration device(std::size_t number, const std::string& frame, bool is_adopted) const;
};

/// Estimates all terms, then once more without those that are not significant until the others are. `estimate`: called
/// with the terms that may differ from zero; an estimate without terms: there is nothing to estimate from.
TermSelection selectTerms(std::size_t terms,
                          const std::function<TermEstimate(const std::vector<bool>& wanted)>& estimate);

/// Returns the terms that are not constrained, in words.
std::vector<std::string> describeUnconstrained(const TermEstimate& estimate, const std::vector<MountedLaser>& lasers);

}  // namespace laser_mapper
