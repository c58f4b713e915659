// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fabmap_node/features/feature_extractor.hpp"
#include "fabmap_node/model/place_model.hpp"

namespace fabmap_node {

/// Whether an observation is suitable for recognition, or why not. Numbers are stored: append new ones.
enum class ObservationStatus {
  Used = 0,
  NoImage = 1,         ///< no image of any camera
  Dark = 2,            ///< the images are too dark
  Blank = 3,           ///< the images have no contrast: fog, covered lens, overexposure
  Blurred = 4,         ///< the images have contrast, but no corners
  TooFewFeatures = 5,  ///< fewer words than required
};
/// Returns "used", "no_image", "dark", "blank", "blurred" or "too_few_features".
const char* toString(ObservationStatus status);

/// Observation prepared for recognition: its words, and the features for descriptor matching.
struct PlaceDescription {
  ObservationStatus status = ObservationStatus::Used;
  std::uint8_t cameras = 1;  ///< in one revolution
  std::uint8_t missing = 0;  ///< cameras without an image
  WordSet words;
  std::string look;  ///< packLook()
};

/// Converts observations to the words of a model. Thread-safe; the model must outlive it.
class PlaceDescriber {
 public:
  PlaceDescriber(const PlaceModel& model, const FeatureOptions& features, std::size_t look_features)
      : vocabulary_(model.vocabulary), extractor_(features), look_features_(look_features) {}

  /// `images`: as in FeatureExtractor::extract().
  PlaceDescription describe(const std::vector<urban_nav_core::ImageView>& images) const;
  PlaceDescription describe(const PlaceObservation& observation) const;

 private:
  const Vocabulary& vocabulary_;
  FeatureExtractor extractor_;
  std::size_t look_features_;
};

}  // namespace fabmap_node
