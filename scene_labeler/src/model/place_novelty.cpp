// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/place_novelty.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

namespace scene_labeler {
namespace {

constexpr std::size_t kDrawnReturns = 200, kFewestReturns = 20;
constexpr std::size_t kReferenceSamples = 300;  // whose distances determine the limit
constexpr std::size_t kLeastWithAspect = 50;    // samples with such features that are required
constexpr double kReferenceShare = 0.95;
constexpr double kUsualShare = 0.1, kNewPlaceShare = 0.3;
constexpr double kMostReduction = 0.5;  // scene_labeler/bench/other_worlds.py

bool endsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// Returns the columns of image features in windows or histograms; of two windows those of the wider one.
std::vector<std::size_t> appearanceColumns(FeatureSet set) {
  const std::vector<std::string>& names = featureNames(set);
  std::vector<std::size_t> columns;
  for (std::size_t i = firstImageFeature(set); i < names.size(); ++i)
    if (set == FeatureSet::Paper || endsWith(names[i], "_21")) columns.push_back(i);
  return columns;
}

/// Returns the columns of shape in the largest cubes and of heights; reflectance depends on the device.
std::vector<std::size_t> shapeColumns(FeatureSet set) {
  const std::vector<std::string>& names = featureNames(set);
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < firstImageFeature(set); ++i) {
    const bool is_fine = endsWith(names[i], "_0.1") || endsWith(names[i], "_0.2");
    const bool is_reflectance = names[i].find("reflectance") == 0;
    if (!is_fine && !is_reflectance) columns.push_back(i);
  }
  return columns;
}

template <typename Codes>
int distance(const Codes& a, const Codes& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  return sum;
}

}  // namespace

PlaceNovelty::Codes PlaceNovelty::Aspect::encode(const FeatureBins& bins, const float* row) const {
  Codes codes{};
  for (std::size_t i = 0; i < columns.size(); ++i) codes[i] = bins.code(columns[i], row[columns[i]]);
  return codes;
}

bool PlaceNovelty::Aspect::hasNear(const Codes& codes) const {
  return std::any_of(samples.begin(), samples.end(),
                     [&](const Codes& sample) { return distance(sample, codes) <= limit; });
}

void PlaceNovelty::Aspect::learn(const ModelSamples& stored, std::size_t row_length) {
  if (columns.empty()) return;
  if (columns.size() > kMostColumns) columns.resize(kMostColumns);
  std::vector<std::uint16_t> places;
  for (std::size_t sample = 0; sample < stored.size(); ++sample) {
    const std::uint8_t* row = stored.codes.data() + sample * row_length;
    if (row[columns.front()] == 0) continue;
    Codes codes{};
    for (std::size_t i = 0; i < columns.size(); ++i) codes[i] = row[columns[i]];
    samples.push_back(codes);
    places.push_back(stored.places[sample]);
  }
  std::vector<int> distances;
  const std::size_t wanted = std::min(kReferenceSamples, samples.size());
  for (std::size_t n = 0; n < wanted && samples.size() >= kLeastWithAspect; ++n) {
    const std::size_t one = n * samples.size() / wanted;
    int nearest = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (places[i] != places[one]) nearest = std::min(nearest, distance(samples[i], samples[one]));
    if (nearest < std::numeric_limits<int>::max()) distances.push_back(nearest);
  }
  if (distances.empty()) return samples.clear();
  const auto at =
      distances.begin() + static_cast<std::ptrdiff_t>(kReferenceShare * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), at, distances.end());
  limit = *at;
}

PlaceNovelty::PlaceNovelty(FeatureSet features, const FeatureBins& bins, const ModelSamples& samples) {
  appearance_.columns = appearanceColumns(features);
  shape_.columns = shapeColumns(features);
  appearance_.learn(samples, bins.columns());
  shape_.learn(samples, bins.columns());
}

double PlaceNovelty::Aspect::shareUnlike(const FeatureBins& bins, const FeatureTable& table,
                                         const std::vector<std::uint8_t>& is_asked) const {
  if (samples.empty()) return 0.0;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < is_asked.size(); ++i)
    if (is_asked[i] != 0 && !std::isnan(table.row(i)[columns.front()])) rows.push_back(i);
  if (rows.size() < kFewestReturns) return 0.0;
  const std::size_t drawn = std::min(kDrawnReturns, rows.size());
  std::size_t unlike = 0;
  for (std::size_t n = 0; n < drawn; ++n)
    unlike += hasNear(encode(bins, table.row(rows[n * rows.size() / drawn]))) ? 0U : 1U;
  return static_cast<double>(unlike) / static_cast<double>(drawn);
}

bool PlaceNovelty::Aspect::isNovel(const FeatureBins& bins, const float* row) const {
  return !samples.empty() && !std::isnan(row[columns.front()]) && !hasNear(encode(bins, row));
}

bool PlaceNovelty::isNovel(const FeatureBins& bins, const float* row) const {
  const std::array<const Aspect*, 2> aspects = {&appearance_, &shape_};
  return std::any_of(aspects.begin(), aspects.end(), [&](const Aspect* aspect) { return aspect->isNovel(bins, row); });
}

double PlaceNovelty::shareUnlike(const FeatureBins& bins, const FeatureTable& table,
                                 const std::vector<std::uint8_t>& is_asked) const {
  return std::max(appearance_.shareUnlike(bins, table, is_asked), shape_.shareUnlike(bins, table, is_asked));
}

bool isNewPlace(double share_unlike) { return 2.0 * share_unlike > kUsualShare + kNewPlaceShare; }

double excessNovelty(double share_unlike) {
  return std::clamp((share_unlike - kUsualShare) / (kNewPlaceShare - kUsualShare), 0.0, 1.0);
}

std::string newPlaceWarning(std::size_t new_place_frames, std::size_t frames) {
  if (new_place_frames == 0 || 4 * new_place_frames < frames) return "";
  return std::to_string(new_place_frames) + " of " + std::to_string(frames) +
         " frames show a kind of place that is not in the training data: more labels are unsure there. Train the model "
         "with corrections (labels train --add)";
}

void doubtKinds(double share_unlike, const std::vector<SceneClass>& classes, float* probabilities) {
  const double novelty = excessNovelty(share_unlike);
  if (novelty == 0.0) return;
  const auto doubt = static_cast<float>(kMostReduction * novelty);
  for (const bool of_ground : {true, false}) {
    const auto isKind = [&](std::size_t k) { return isKindOfGround(classes[k]) == of_ground; };
    float sum = 0.0F, count = 0.0F;
    for (std::size_t k = 0; k < classes.size(); ++k) {
      if (!isKind(k)) continue;
      sum += probabilities[k];
      count += 1.0F;
    }
    for (std::size_t k = 0; k < classes.size(); ++k)
      if (isKind(k)) probabilities[k] += doubt * (sum / count - probabilities[k]);
  }
}

}  // namespace scene_labeler
