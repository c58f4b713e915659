// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/io/cloud/cloud_file.hpp"

namespace urban_nav {

/// Returns a hint on units and frames of two clouds that cannot be aligned, for the user: a point spacing far above
/// that of scans in metres (centimetres, millimetres, or different scales), or centres kilometres apart (local
/// coordinates and UTM). Empty without such a sign. Requires clouds after recentre().
std::string describeUnits(const urban_nav_core::CloudFile& source, const urban_nav_core::CloudFile& target);

}  // namespace urban_nav
