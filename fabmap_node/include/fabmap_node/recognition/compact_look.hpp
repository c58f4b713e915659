// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "fabmap_node/recognition/second_look.hpp"

namespace fabmap_node {

/// Encodes the features for descriptor matching: 4 bits per element of a descriptor, 16 per coordinate of a direction,
/// 37 bytes per feature in total. Identical on every machine.
std::string packLook(const LookFeatures& look);
/// Inverse of packLook(), with the resolution of the encoding. Throws DataError with `name` if the bytes are damaged.
LookFeatures unpackLook(std::string_view bytes, const std::string& name);
/// Returns LookFeatures::cameras of packLook() without unpacking the features. Throws like unpackLook().
std::uint8_t checkLook(std::string_view bytes, const std::string& name);

}  // namespace fabmap_node
