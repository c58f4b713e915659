// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/prior_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "urban_nav_core/parallel/for_each.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kLeastSites = 5;  // with fewer, their variation is known to no better than 40 %
constexpr std::size_t kLeastSitesOfKind = 2;
constexpr std::array<double, 10> kDeviations = {1.25, 2.5, 5.0, 10.0, 20.0, 40.0, 80.0, 160.0, 320.0, 640.0};

/// Samples of one site.
struct SiteFold {
  std::vector<CalibrationSample> held_out, others;
};

/// Weighted sum of the losses of one site, and of the weights.
struct SiteLoss {
  double loss = 0.0, weight = 0.0;
};

std::vector<SiteFold> makeFolds(const std::vector<CalibrationSample>& samples) {
  std::map<std::size_t, SiteFold> folds;
  for (const CalibrationSample& sample : samples) folds[sample.site].held_out.push_back(sample);
  std::vector<SiteFold> made;
  for (auto& [site, fold] : folds) {
    for (const CalibrationSample& sample : samples)
      if (sample.site != site) fold.others.push_back(sample);
    made.push_back(std::move(fold));
  }
  return made;
}

std::size_t countSitesWith(const std::vector<SiteFold>& folds, bool is_same_place) {
  return static_cast<std::size_t>(std::count_if(folds.begin(), folds.end(), [is_same_place](const SiteFold& fold) {
    return std::any_of(fold.held_out.begin(), fold.held_out.end(),
                       [is_same_place](const CalibrationSample& s) { return s.is_same_place == is_same_place; });
  }));
}

/// `right_weight`, `wrong_weight`: total weights of the two kinds.
SiteLoss computeSiteLoss(const SiteFold& fold, double prior_deviation, double right_weight, double wrong_weight) {
  const PlaceCalibration calibration = fitCalibration(fold.others, prior_deviation);
  SiteLoss sum;
  for (const CalibrationSample& sample : fold.held_out) {
    const double p = calibration.probability(sample.evidence);
    const double weight = 0.5 * sample.weight / (sample.is_same_place ? right_weight : wrong_weight);
    sum.loss -= weight * std::log(sample.is_same_place ? p : 1.0 - p);
    sum.weight += weight;
  }
  return sum;
}

/// Returns the sum of the losses, with the standard error of a ratio estimate whose denominator, the sum of weights, is
/// one.
HeldOutLoss sumSites(double prior_deviation, const std::vector<SiteLoss>& sites) {
  HeldOutLoss sum;
  sum.prior_deviation = prior_deviation;
  for (const SiteLoss& site : sites) sum.log_loss += site.loss;
  double squares = 0.0;
  for (const SiteLoss& site : sites) {
    const double residual = site.loss - sum.log_loss * site.weight;
    squares += residual * residual;
  }
  const auto count = static_cast<double>(sites.size());
  sum.standard_error = std::sqrt(squares * count / (count - 1.0));
  return sum;
}

}  // namespace

PriorChoice choosePrior(const std::vector<CalibrationSample>& samples) {
  PriorChoice choice;
  const std::vector<SiteFold> folds = makeFolds(samples);
  if (folds.size() < kLeastSites || countSitesWith(folds, true) < kLeastSitesOfKind ||
      countSitesWith(folds, false) < kLeastSitesOfKind)
    return choice;
  double right_weight = 0.0, wrong_weight = 0.0;
  for (const CalibrationSample& sample : samples) (sample.is_same_place ? right_weight : wrong_weight) += sample.weight;
  std::vector<std::vector<SiteLoss>> losses(kDeviations.size(), std::vector<SiteLoss>(folds.size()));
  urban_nav_core::forEach(kDeviations.size() * folds.size(), 1, [&](std::size_t task) {
    const std::size_t d = task / folds.size(), s = task % folds.size();
    losses[d][s] = computeSiteLoss(folds[s], kDeviations[d], right_weight, wrong_weight);
  });
  for (std::size_t d = 0; d < kDeviations.size(); ++d) choice.losses.push_back(sumSites(kDeviations[d], losses[d]));
  const auto best =
      std::min_element(choice.losses.begin(), choice.losses.end(),
                       [](const HeldOutLoss& a, const HeldOutLoss& b) { return a.log_loss < b.log_loss; });
  choice.prior_deviation = best->prior_deviation;
  return choice;
}

}  // namespace fabmap_node
