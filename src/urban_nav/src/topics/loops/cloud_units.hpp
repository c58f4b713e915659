// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/io/cloud/cloud_file.hpp"

namespace urban_nav {

/// Returns what the numbers of two clouds that cannot be aligned show of their units and frames, for the user: spacing
/// far above that of scans in metres (centimetres, millimetres, or another scale in one of them), or middles kilometres
/// apart (local coordinates and UTM). Empty where nothing is conspicuous. Clouds: as recentre() leaves them.
std::string describeUnits(const urban_nav_core::CloudFile& source, const urban_nav_core::CloudFile& target);

}  // namespace urban_nav
