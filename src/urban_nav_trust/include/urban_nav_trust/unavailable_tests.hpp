// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace urban_nav_trust {

// Tests that do not exist, although their measurements may. They are listed as absent with the reason.
constexpr const char* kColourTest = "panorama_colour";  ///< colours of panoramas against those of the map

constexpr std::array<const char*, 1> kUnavailableTests = {kColourTest};

}  // namespace urban_nav_trust
