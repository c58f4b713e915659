// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "calibration/calibration_terms.hpp"
#include "mounted_laser.hpp"

namespace laser_mapper {

/// Returns the standard deviations of the prior, s, m and rad: plausible errors of each term.
TermVector priorSigmas();

/// Gaussian of the terms of all lasers, 7 each.
struct TermEstimate {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd conditional_sigma;  ///< of each term given all others

  double sigma(Eigen::Index term) const { return std::sqrt(covariance(term, term)); }
  /// Returns whether the measurements determine a term better than the prior.
  bool isConstrained(Eigen::Index term) const;
};

/// Returns which terms differ significantly from zero. Delay, shift and turn of each laser are selected as groups: the
/// least significant group is set to zero until all others are significant at 99.9 %.
std::vector<bool> significantTerms(const TermEstimate& estimate);

/// Result of estimating the terms of some devices.
struct TermSelection {
  TermEstimate all;               ///< of all terms
  TermEstimate chosen;            ///< of the significant terms, the others zero
  std::vector<bool> significant;  ///< differ significantly from zero and are observable together

  bool holdsAny() const;
  /// Returns the terms of a device; the significant ones are adopted if `is_adopted`.
  DeviceCalibration device(std::size_t number, const std::string& frame, bool is_adopted) const;
};

/// Estimates all terms, then again without insignificant ones until the others are significant. `estimate`: called with
/// the terms that may differ from zero; returns no terms if there are no data.
TermSelection selectTerms(std::size_t terms,
                          const std::function<TermEstimate(const std::vector<bool>& wanted)>& estimate);

/// Returns descriptions of the terms that are not constrained.
std::vector<std::string> describeUnconstrained(const TermEstimate& estimate, const std::vector<MountedLaser>& lasers);

}  // namespace laser_mapper
