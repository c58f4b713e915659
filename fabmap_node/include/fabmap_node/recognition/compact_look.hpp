// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "fabmap_node/recognition/second_look.hpp"

namespace fabmap_node {

/// Features that a second look at a panorama compares: 19 993 bytes of packLook().
inline constexpr std::size_t kLookFeatures = 1052;

/// Returns the bytes of a second look's features: 2 bits per element of a descriptor, 16 for the azimuth, 8 for the
/// height, 19 bytes per feature in total. Equal features give equal bytes on every machine.
std::string packLook(const LookFeatures& look);
/// Returns the features of packLook(), rounded as stored. Reads the form before, too: up to 540 features with elements
/// of 4 bits, of which the levels are taken. Throws DataError with `name` if the bytes are damaged.
LookFeatures unpackLook(std::string_view bytes, const std::string& name);
/// Returns LookFeatures::cameras of packLook() without unpacking the features. Throws as unpackLook().
std::uint8_t checkLook(std::string_view bytes, const std::string& name);

}  // namespace fabmap_node
