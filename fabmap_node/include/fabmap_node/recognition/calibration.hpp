// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace fabmap_node {

/// Evidence that an observation shows the compared place, in quantities that do not depend on the sizes of vocabulary
/// and map. Larger values support the place.
struct PlaceEvidence {
  double word_ratio = 0.0;   ///< log likelihood ratio to a new place, per word, nats
  double word_margin = 0.0;  ///< log likelihood ratio to the likeliest place elsewhere, per word, nats
  double look = 0.0;         ///< square root of LookAgreement::share; 0 without descriptor matching
  double look_margin = 0.0;  ///< `look` minus that of the best place elsewhere; 0 without one
  double sequence = 0.0;     ///< LocationFilter::pathMargin(); 0 without a sequence

  static constexpr std::size_t kSize = 5;
  std::array<double, kSize> values() const { return {word_ratio, word_margin, look, look_margin, sequence}; }
};

/// Evidence with ground truth, from drives that were not used to train the model.
struct CalibrationSample {
  PlaceEvidence evidence;
  bool is_same_place = false;
  double weight = 1.0;   ///< relative to other samples of its kind
  std::size_t site = 0;  ///< of the query; samples of one site are correlated
};

/// Logistic regression from evidence to the probability that the place is correct. The probability is limited by the
/// number of samples: it lies between 1 / (n + 2) and 1 - 1 / (n + 2) for n samples of each kind.
struct PlaceCalibration {
  double bias = -6.0;
  std::array<double, PlaceEvidence::kSize> weights{};  ///< not negative
  double floor = 0.01, ceiling = 0.99;                 ///< limits of the probability

  double logit(const PlaceEvidence& evidence) const;
  double probability(const PlaceEvidence& evidence) const;
};

/// Standard deviation of the prior on weights of standardised evidence if none can be chosen by validation: wide enough
/// for any plausible weight (Gelman et al. 2008, section 3).
inline constexpr double kDefaultPriorDeviation = 5.0;

/// Fits a calibration by maximum a posteriori, with a Gaussian prior of that standard deviation on weights and bias of
/// standardised evidence. Both kinds of samples have the same total weight: places of the map and new places are
/// equally probable a priori. Samples are from drives: neighbours are similar, and twenty of them count as one. Returns
/// the default, which announces nothing, unless there are samples of both kinds. Requires prior_deviation > 0.
PlaceCalibration fitCalibration(const std::vector<CalibrationSample>& samples,
                                double prior_deviation = kDefaultPriorDeviation);

}  // namespace fabmap_node
