// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fabmap_node/recognition/calibration.hpp"

namespace fabmap_node {

/// Prediction loss at held-out sites for one standard deviation of the prior.
struct HeldOutLoss {
  double prior_deviation = 0.0;
  double log_loss = 0.0;        ///< mean over the samples, with equal total weight of both kinds, nats
  double standard_error = 0.0;  ///< of `log_loss`, from its variation over sites
};

/// Standard deviation of the prior of a calibration.
struct PriorChoice {
  double prior_deviation = kDefaultPriorDeviation;
  std::vector<HeldOutLoss> losses;  ///< for all deviations, ascending; empty with too few sites
};

/// Chooses the standard deviation of the prior of fitCalibration() by leave-one-site-out cross-validation: that of the
/// smallest loss (Hastie et al. 2009, section 7.10). The smallest deviation within a standard error would depend on the
/// differences between sites: a site that is difficult for every deviation enlarges the error, and probabilities are
/// then nearer to 0.5 than the samples state. Returns the default with fewer than five sites, or unless samples of both
/// kinds exist at two sites. Deterministic for any number of threads.
PriorChoice choosePrior(const std::vector<CalibrationSample>& samples);

}  // namespace fabmap_node
