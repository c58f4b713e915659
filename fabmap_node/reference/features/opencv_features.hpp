// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"
#include "urban_nav_core/image/view.hpp"

namespace fabmap_node {

/// Detectors and descriptors of OpenCV, with which the features of this package are compared.
enum class OpenCvFeature {
  Sift,  ///< Lowe 2004
  Orb,   ///< Rublee et al. 2011
};

/// Names of the enumerators, in their order.
inline constexpr std::array<const char*, 2> kOpenCvFeatureNames = {"sift", "orb"};

/// Returns the features of a single image, at most `wanted`, strongest first, with OpenCV's default settings. The 128
/// elements of a SIFT descriptor are kept. Of the 256 tests of an ORB descriptor, which are sorted by variance, the
/// first 128 become 0 or 45: squared distances are proportional to the Hamming distance, and a descriptor with half of
/// its tests true has the length 360 of 512. Thread-safe. Throws UserError if this OpenCV has no SIFT (before 4.4).
PlaceObservation openCvObservation(OpenCvFeature feature, const urban_nav_core::ImageView& image, int wanted);

}  // namespace fabmap_node
