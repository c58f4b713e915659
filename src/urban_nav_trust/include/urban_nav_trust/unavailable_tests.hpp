// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace urban_nav_trust {

// Tests that do not exist, although their measurements may. They are listed as absent with the reason.
constexpr const char* kColourTest = "panorama_colour";           ///< colours of panoramas against those of the map
constexpr const char* kFixTest = "gps_position";                 ///< GPS fixes against the path
constexpr const char* kFreeSpaceTest = "free_space";             ///< beams that pass through surfaces of the map
constexpr const char* kPassTest = "plane_passes";                ///< planes of one pass against those of another
constexpr const char* kReprojectionTest = "reprojection_error";  ///< change of the reprojection error over time

constexpr std::array<const char*, 5> kUnavailableTests = {kColourTest, kFixTest, kFreeSpaceTest, kPassTest,
                                                          kReprojectionTest};

}  // namespace urban_nav_trust
