// SPDX-License-Identifier: BSD-3-Clause
#include "labelling/sure_rule.hpp"

#include <algorithm>

namespace scene_labeler {
namespace {

constexpr float kLeastStated = 0.5F;         // below it, another class may be as probable
constexpr double kUsualShareOutside = 0.1;   // of returns with features outside the training data
/// Errors in a new kind of place over those in held-out sites of known kinds, at equal probability
/// (docs/results/scene_labeler.md).
constexpr double kErrorsInNewPlace = 4.0;
/// Models of version 3: in known places, in scenes with many returns outside the training data, in others.
constexpr float kFixedSure = 0.5F, kFixedSureOutside = 0.7F, kFixedSureElsewhere = 0.8F;

float fixedThreshold(const SureRule::Place& place) {
  if (isNewPlace(place.share_unlike) || place.has_other_device) return kFixedSureElsewhere;
  return place.share_outside > kUsualShareOutside ? kFixedSureOutside : kFixedSure;
}

/// Returns the threshold for errors that are `factor` times as frequent as in cross-validation.
float thresholdFor(const LabelModel& model, double factor) {
  return model.sure.rowFor(1.0 - (1.0 - model.precision) / factor).least;
}

}  // namespace

SureRule::SureRule(const LabelModel& model, const Place& place)
    : is_fixed_(model.sure.empty()), is_outside_common_(place.share_outside > kUsualShareOutside) {
  if (is_fixed_) {
    least_ = least_outside_ = fixedThreshold(place);
    return;
  }
  tests_novelty_ = excessNovelty(place.share_unlike) > 0.0;
  const double novelty =
      place.has_other_device ? 1.0 : excessNovelty(std::max(place.share_unlike, place.share_outside));
  least_ = thresholdFor(model, 1.0 + (kErrorsInNewPlace - 1.0) * novelty);
  least_outside_ = thresholdFor(model, kErrorsInNewPlace);
}

bool SureRule::isUnsure(float probability, float stated, bool is_outside) const {
  if (is_fixed_) return is_outside || stated < least_;
  if (stated < kLeastStated) return true;
  if (is_outside) return !is_outside_common_ || probability < least_outside_;
  return probability < least_;
}

}  // namespace scene_labeler
