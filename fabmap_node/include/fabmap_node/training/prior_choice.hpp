// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fabmap_node/recognition/calibration.hpp"

namespace fabmap_node {

/// What a fit with a prior of one deviation predicts for sites that it has not seen.
struct HeldOutLoss {
  double prior_deviation = 0.0;
  double log_loss = 0.0;        ///< mean of the samples, right and wrong ones weighing the same, nats
  double standard_error = 0.0;  ///< of `log_loss`, from its scatter over sites
};

/// Deviation of the prior of a calibration.
struct PriorChoice {
  double prior_deviation = kDefaultPriorDeviation;
  std::vector<HeldOutLoss> losses;  ///< of all deviations, ascending; empty if there are too few sites to compare them
};

/// Chooses the deviation of the prior of fitCalibration() by leaving one site out: the samples of each site are
/// predicted by the fit to those of all others. Of the deviations, the smallest whose loss exceeds the lowest one by no
/// more than the standard error of that one is chosen (Hastie et al. 2009, section 7.10). Returns the default with
/// fewer than five sites, or unless both kinds of samples are at two. Deterministic for any number of threads.
PriorChoice choosePrior(const std::vector<CalibrationSample>& samples);

}  // namespace fabmap_node
