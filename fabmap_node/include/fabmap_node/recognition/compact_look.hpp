// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "fabmap_node/recognition/second_look.hpp"

namespace fabmap_node {

/// Bytes of packLook() per feature. Single image: 4 bits per element of the descriptor, 8 for the camera, 16 per
/// coordinate of the direction. Panorama: 2 bits per element, 16 for the azimuth, 8 for the elevation.
inline constexpr std::size_t kSingleFeatureBytes = 37, kPanoramaFeatureBytes = 19;

/// Encodes the features for descriptor matching. Identical on every machine.
std::string packLook(const ComparedFeatures& look);
/// Inverse of packLook(), with the resolution of the encoding. Also reads panoramas in the encoding of single images,
/// as stored by earlier versions: about half as many features. Throws DataError with `name` if the bytes are damaged.
ComparedFeatures unpackLook(std::string_view bytes, const std::string& name);
/// Returns ComparedFeatures::cameras of packLook() without unpacking the features. Throws like unpackLook().
std::uint8_t checkLook(std::string_view bytes, const std::string& name);

}  // namespace fabmap_node
