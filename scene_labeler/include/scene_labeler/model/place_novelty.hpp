// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "scene_labeler/features/features.hpp"
#include "scene_labeler/model/feature_bins.hpp"
#include "scene_labeler/model/model_samples.hpp"

namespace scene_labeler {

/// How unlike the places of its training a model finds a scene. Distances between returns are sums of differences
/// between the codes of some features: those of the wider window of the image, or those of the shape. A return is
/// unlike the training data if no sample is as near to it as 95 % of the samples are to those of other drives or
/// scenes: in a place of a known kind 5 % are. Thread-safe once made.
class PlaceNovelty {
 public:
  /// Finds nothing unlike the training, as does a model without samples, or with those of one drive alone.
  PlaceNovelty() = default;
  PlaceNovelty(FeatureSet features, const FeatureBins& bins, const ModelSamples& samples);

  /// Returns the share of unlike ones among at most 200 of the returns, evenly drawn from those for which `is_asked` is
  /// not 0 (one per row of the table): by look, of those that an image shows, or by shape, whichever is larger. 0 of
  /// fewer than 20.
  double shareUnlike(const FeatureBins& bins, const FeatureTable& table,
                     const std::vector<std::uint8_t>& is_asked) const;

 private:
  static constexpr std::size_t kMostColumns = 16;
  using Codes = std::array<std::uint8_t, kMostColumns>;

  /// Some features, and what the samples have of them.
  struct Aspect {
    std::vector<std::size_t> columns;  // the first one is missing in returns without this aspect
    std::vector<Codes> samples;
    int limit = 0;  // distance; beyond it a return is unlike the samples

    Codes encode(const FeatureBins& bins, const float* row) const;
    bool hasNear(const Codes& codes) const;
    double shareUnlike(const FeatureBins& bins, const FeatureTable& table,
                       const std::vector<std::uint8_t>& is_asked) const;
    void learn(const ModelSamples& stored, std::size_t row_length);
  };

  Aspect look_, shape_;
};

/// Whether so many returns, over a fifth, are unlike the training data that this is a kind of place the model was not
/// trained in.
bool isNewPlace(double share_unlike);

/// Returns the warning that so many of the frames show such a place; empty if less than a quarter of them do.
std::string newPlaceWarning(std::size_t new_place_frames, std::size_t frames);

/// Takes back half of what a model says of kinds of ground, and of kinds of other things: that much of the probability
/// of all of them is divided evenly among them, as in a place of a new kind a model is right about half the time. Less
/// of it from a tenth of unlike returns on, nothing below. `probabilities`: one for each of `classes`.
void doubtKinds(double share_unlike, const std::vector<SceneClass>& classes, float* probabilities);

}  // namespace scene_labeler
