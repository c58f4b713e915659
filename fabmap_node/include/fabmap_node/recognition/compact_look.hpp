// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "fabmap_node/recognition/second_look.hpp"

namespace fabmap_node {

/// Returns the bytes of a second look's features: 4 bits per element of a descriptor, 16 per coordinate of a direction,
/// 37 bytes per feature in total. Equal features give equal bytes on every machine.
std::string packLook(const LookFeatures& look);
/// Returns the features of packLook(), rounded as stored. Throws DataError with `name` if the bytes are damaged.
LookFeatures unpackLook(std::string_view bytes, const std::string& name);
/// Returns LookFeatures::cameras of packLook() without unpacking the features. Throws as unpackLook().
std::uint8_t checkLook(std::string_view bytes, const std::string& name);

}  // namespace fabmap_node
