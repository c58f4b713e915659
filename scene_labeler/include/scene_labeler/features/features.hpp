// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Which features a classifier works with.
enum class FeatureSet : std::uint8_t {
  Paper,  ///< height, normal, histograms of hue and saturation (Newman et al. 2009, section 8.1)
  All,    ///< shape at several scales, height and spread, reflectance, colour and gradients
};
const char* toString(FeatureSet set);

/// Returns the names of the features of a set, in the order of their columns.
const std::vector<std::string>& featureNames(FeatureSet set);

/// Returns the index of the first feature of an image; the features before it are those of the cloud.
std::size_t firstImageFeature(FeatureSet set);

/// Measures the features of all returns of a scene. Returns that the image does not show have missing values for the
/// features of an image; returns that are not finite have missing values only. The result does not depend on the number
/// of threads, nor on the order of the returns except for rounding. `with_reflectance`: false leaves out the scene's
/// reflectance. Thread-safe.
FeatureTable measureFeatures(const Scene& scene, FeatureSet set, bool with_reflectance = true);

/// Measures the features of the image of a scene again; those of the cloud stay. Thread-safe.
void measureImageFeatures(const Scene& scene, FeatureSet set, FeatureTable& table);

}  // namespace scene_labeler
