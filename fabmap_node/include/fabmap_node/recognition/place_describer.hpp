// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fabmap_node/features/feature_extractor.hpp"
#include "fabmap_node/model/place_model.hpp"

namespace fabmap_node {

/// Whether an observation can be recognised, or why not. Numbers are stored: new ones are appended.
enum class ObservationStatus {
  Used = 0,
  NoImage = 1,         ///< no image of any camera
  Dark = 2,            ///< the images are too dark
  Blank = 3,           ///< the images have no contrast: fog, a covered lens, overexposure
  Blurred = 4,         ///< the images have contrast, but no corners
  TooFewFeatures = 5,  ///< fewer words than a place needs
};
/// "used", "no_image", "dark", "blank", "blurred", "too_few_features".
const char* toString(ObservationStatus status);

/// Observation prepared for recognition: its words, and what a second look compares.
struct PlaceDescription {
  ObservationStatus status = ObservationStatus::Used;
  std::uint8_t cameras = 1;  ///< in one revolution
  std::uint8_t missing = 0;  ///< cameras without an image
  WordSet words;
  std::string look;  ///< packLook()
};

/// Describes observations in the words of a model. Thread-safe; the model must outlive it.
class PlaceDescriber {
 public:
  PlaceDescriber(const PlaceModel& model, const FeatureOptions& features, std::size_t look_features)
      : vocabulary_(model.vocabulary), extractor_(features), look_features_(look_features) {}

  /// `images`: as FeatureExtractor::extract() takes them.
  PlaceDescription describe(const std::vector<urban_nav_core::ImageView>& images) const;
  PlaceDescription describe(const PlaceObservation& observation) const;

 private:
  const Vocabulary& vocabulary_;
  FeatureExtractor extractor_;
  std::size_t look_features_;
};

}  // namespace fabmap_node
