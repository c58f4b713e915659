// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene_labeler/features/feature_table.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Returns the names of the image features of a return: colour, its deviation, and gradients in two windows.
std::vector<std::string> lookFeatureNames();

/// Writes the image features into columns `first`, `first` + 1, ... for the visible returns. Saturated and black pixels
/// are ignored; features of a window with too few others are missing.
void measureLook(const Scene& scene, std::size_t first, FeatureTable& table);

/// Returns the names of the histograms of hue and saturation in a window of 15x15 px (Newman et al. 2009, section 8.1).
std::vector<std::string> paperLookNames();
void measurePaperLook(const Scene& scene, std::size_t first, FeatureTable& table);

}  // namespace scene_labeler
