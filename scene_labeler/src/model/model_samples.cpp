// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/model_samples.hpp"

#include <algorithm>

#include "scene_labeler/model/feature_bins.hpp"

namespace scene_labeler {

void ModelSamples::archive(urban_nav_core::Archive& archive, std::size_t columns, std::size_t classes) {
  archive(folds, codes, labels, weights, places, frequencies);
  if (!archive.isReading()) return;
  bool is_sound = codes.size() == labels.size() * columns && weights.size() == labels.size() &&
                  places.size() == labels.size() && (labels.empty() || frequencies.size() == classes);
  for (const std::uint8_t code : codes) is_sound = is_sound && code < FeatureBins::kCodeCount;
  for (const std::uint8_t label : labels) is_sound = is_sound && label < classes;
  for (const std::uint8_t weight : weights) is_sound = is_sound && weight > 0;
  for (const std::uint16_t place : places) is_sound = is_sound && place < folds.size();
  for (const float frequency : frequencies) is_sound = is_sound && frequency >= 0.0F;
  archive.require(is_sound, "its training samples do not match the model");
}

}  // namespace scene_labeler
