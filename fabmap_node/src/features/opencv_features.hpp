// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fabmap_node/features/feature_kind.hpp"
#include "fabmap_node/features/place_observation.hpp"
#include "urban_nav_core/image/view.hpp"

namespace fabmap_node {

/// Returns at most `wanted` features of OpenCV's SIFT or ORB with its default settings, the best first. SIFT's 128
/// elements are kept as they are. Of ORB's 256 tests, which are sorted by how much they tell, the first 128 become 0 or
/// 45: squared distances are proportional to the Hamming distance, and half of the tests true make the length 360 of
/// 512. Throws UserError if this OpenCV has no SIFT (before 4.4).
std::vector<PlaceFeature> openCvFeatures(FeatureKind kind, const urban_nav_core::ImageView& image, int wanted,
                                         std::uint8_t camera);

}  // namespace fabmap_node
