// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fabmap_node/features/place_observation.hpp"
#include "urban_nav_core/image/view.hpp"

namespace fabmap_node {
/// Limits on the number of features per image.
struct FeatureOptions {
  int single = 500;    ///< largest number of features of a single image
  int panorama = 250;  ///< largest number of features of one image of a panorama
};

/// Extracts features for place recognition: FAST corners at several pyramid levels, distributed by a quadtree, the best
/// by Harris score first (Newman et al. 2009, section 2.4 (i) and (v)), each with the upright descriptor of keyframes.
/// Upright descriptors suit a wheeled robot, and distinguish a window sill from a door post. Deterministic.
/// Thread-safe.
class FeatureExtractor {
 public:
  explicit FeatureExtractor(const FeatureOptions& options = {}) : options_(options) {}

  /// One image: single camera. Several: images of a panorama, in order around the vertical axis; an empty view is a
  /// missing image.
  PlaceObservation extract(const std::vector<urban_nav_core::ImageView>& images) const;

 private:
  FeatureOptions options_;
};

}  // namespace fabmap_node
