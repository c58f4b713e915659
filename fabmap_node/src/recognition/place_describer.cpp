// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_describer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fabmap_node/recognition/compact_look.hpp"
#include "fabmap_node/recognition/second_look.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::ImageView;

constexpr std::size_t kLeastWords = 30;   // per observation; with fewer no place is unique
constexpr double kDarkBrightness = 16.0;  // grey level below which an image is dark, if its contrast is low too
constexpr double kBlankDeviation = 6.0;   // grey levels: images with less contrast contain only noise
constexpr int kBrightnessStep = 4;        // pixels and rows between samples

struct ImageStatistics {
  double mean = 0.0, deviation = 0.0;
};

ImageStatistics imageStatistics(const std::vector<ImageView>& images) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const ImageView& image : images) {
    for (int v = 0; v < image.height; v += kBrightnessStep)
      for (int u = 0; u < image.width; u += kBrightnessStep) {
        const double grey = image.at(u, v);
        sum += grey;
        squares += grey * grey;
        count += 1.0;
      }
  }
  if (count == 0.0) return {};
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

ObservationStatus reasonOfTooFewFeatures(const std::vector<ImageView>& images) {
  const ImageStatistics statistics = imageStatistics(images);
  if (statistics.mean < kDarkBrightness) return ObservationStatus::Dark;
  return statistics.deviation < kBlankDeviation ? ObservationStatus::Blank : ObservationStatus::Blurred;
}

}  // namespace

const char* toString(ObservationStatus status) {
  constexpr std::array<const char*, 6> kNames = {"used", "no_image", "dark", "blank", "blurred", "too_few_features"};
  return kNames[static_cast<std::size_t>(status)];
}

PlaceDescription PlaceDescriber::describe(const PlaceObservation& observation) const {
  PlaceDescription description;
  description.cameras = observation.cameras;
  description.words = vocabulary_.words(observation);
  description.look = packLook(selectFeatures(observation, look_features_));
  if (description.words.size() < kLeastWords) description.status = ObservationStatus::TooFewFeatures;
  return description;
}

PlaceDescription PlaceDescriber::describe(const std::vector<ImageView>& images) const {
  PlaceDescription description = describe(extractor_.extract(images));
  description.missing = static_cast<std::uint8_t>(
      std::count_if(images.begin(), images.end(), [](const ImageView& image) { return image.empty(); }));
  if (description.missing == images.size()) description.status = ObservationStatus::NoImage;
  else if (description.status != ObservationStatus::Used) description.status = reasonOfTooFewFeatures(images);
  return description;
}

}  // namespace fabmap_node
