// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Features of a classifier.
enum class FeatureSet : std::uint8_t {
  Paper,  ///< height, normal, histograms of hue and saturation (Newman et al. 2009, section 8.1)
  All,    ///< shape at several scales, height and spread, reflectance, colour and gradients
  Cloud,  ///< shape at the scale of the local spacing and at fixed ones, heights: for clouds of any device and density
};
const char* toString(FeatureSet set);

/// Returns the names of the features of a set, in the order of their columns.
const std::vector<std::string>& featureNames(FeatureSet set);

/// Returns the index of the first image feature; the features before it are those of the cloud.
std::size_t firstImageFeature(FeatureSet set);

/// Computes the features of all returns of a scene. Image features of returns that are not visible in the image are
/// missing; all features of returns that are not finite are missing. The result does not depend on the number of
/// threads, nor on the order of the returns except for rounding. `with_reflectance`: false ignores the scene's
/// reflectance. Thread-safe.
FeatureTable measureFeatures(const Scene& scene, FeatureSet set, bool with_reflectance = true);

/// Recomputes the image features of a scene; those of the cloud are unchanged. Thread-safe.
void measureImageFeatures(const Scene& scene, FeatureSet set, FeatureTable& table);

}  // namespace scene_labeler
