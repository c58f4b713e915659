// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fabmap_node {

inline constexpr std::size_t kDescriptorBytes = 128;
/// Descriptor with 8 bits per element: the unit vector times 512, limited to 255 (Lowe 2004, section 6.1, limits
/// elements to 0.2 of the unit vector before the last normalisation). Sums of products are exact in single precision.
using ByteDescriptor = std::array<std::uint8_t, kDescriptorBytes>;

/// Image point that contributes a word.
struct PlaceFeature {
  ByteDescriptor descriptor{};
  std::uint8_t camera = 0;   ///< index in the panorama; 0 for a single image
  float u = 0.0F, v = 0.0F;  ///< relative to image width and height, 0 ... 1
};

/// Features of one place at one time, of a single image or of all images of a panorama.
struct PlaceObservation {
  std::uint8_t cameras = 1;            ///< images in one revolution: 1 for a single image, 5 for a Ladybug
  std::vector<PlaceFeature> features;  ///< of all images, best first
};

}  // namespace fabmap_node
