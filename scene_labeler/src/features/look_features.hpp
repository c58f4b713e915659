// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Names of the features of the image around a return: colour, its deviation, and gradients in two windows.
std::vector<std::string> lookFeatureNames();

/// Writes the features of the image into columns `first`, `first` + 1, ... for the returns that it shows. Pixels that
/// are saturated or black do not count; a window that has too few others leaves its features missing.
void measureLook(const Scene& scene, std::size_t first, FeatureTable& table);

/// Names of the histograms of hue and saturation in a window of 15x15 px (Newman et al. 2009, section 8.1).
std::vector<std::string> paperLookNames();
void measurePaperLook(const Scene& scene, std::size_t first, FeatureTable& table);

}  // namespace scene_labeler
