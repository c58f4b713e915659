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

/// Measures how much a scene differs from the training places of a model. Distances between returns are sums of
/// differences between codes of some features: those of the image's wider window, or those of the shape. A return is
/// novel if its nearest sample is farther than the nearest sample of another drive or scene is for 95 % of the samples;
/// in a place of a known kind 5 % of the returns are novel. Immutable after construction, hence thread-safe.
class PlaceNovelty {
 public:
  /// Reports no novelty, like a model without samples or with those of a single drive.
  PlaceNovelty() = default;
  PlaceNovelty(FeatureSet features, const FeatureBins& bins, const ModelSamples& samples);

  /// Returns the share of novel returns among at most 200, evenly subsampled from those for which `is_asked` is not 0
  /// (one per row of the table): by image features of visible returns, or by shape, whichever is larger. 0 with fewer
  /// than 20.
  double shareUnlike(const FeatureBins& bins, const FeatureTable& table,
                     const std::vector<std::uint8_t>& is_asked) const;
  /// Returns whether a return, given by its row of features, is novel in appearance or in shape.
  bool isNovel(const FeatureBins& bins, const float* row) const;

 private:
  static constexpr std::size_t kMostColumns = 16;
  using Codes = std::array<std::uint8_t, kMostColumns>;

  /// Subset of features, with the samples' values of them.
  struct Aspect {
    std::vector<std::size_t> columns;  // the first one is missing in returns without these features
    std::vector<Codes> samples;
    int limit = 0;  // distance beyond which a return is novel

    Codes encode(const FeatureBins& bins, const float* row) const;
    bool hasNear(const Codes& codes) const;
    bool isNovel(const FeatureBins& bins, const float* row) const;
    double shareUnlike(const FeatureBins& bins, const FeatureTable& table,
                       const std::vector<std::uint8_t>& is_asked) const;
    void learn(const ModelSamples& stored, std::size_t row_length);
  };

  Aspect appearance_, shape_;
};

/// Returns whether the share of novel returns, over a fifth, indicates a kind of place that is not in the training
/// data.
bool isNewPlace(double share_unlike);

/// Returns how much a share of novel returns exceeds the usual one, a tenth: 0 up to there, 1 from three tenths on.
double excessNovelty(double share_unlike);

/// Returns a warning with the number of frames in such places; empty if they are less than a quarter of all.
std::string newPlaceWarning(std::size_t new_place_frames, std::size_t frames);

/// Reduces the confidence between kinds of ground, and between kinds of other objects: half of the probability of all
/// of them is distributed evenly among them, since in a place of a new kind a model is right about half the time. The
/// share decreases to zero at a tenth of novel returns. `probabilities`: one per `classes`.
void doubtKinds(double share_unlike, const std::vector<SceneClass>& classes, float* probabilities);

}  // namespace scene_labeler
