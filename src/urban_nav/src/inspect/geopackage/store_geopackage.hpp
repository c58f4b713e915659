// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Writes the sessions of a store as layers of a GeoPackage: trajectories, closures, coverage and quality
/// (docs/files.md). `maps`: as readMaps() groups them; `crs`: as MapCrs takes it, or "local" or empty for the frame
/// `map`. Throws UserError for other words, DataError if the GPS fixes of a map do not place it.
void writeGeoPackage(urban_nav_store::Store& store,
                     const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps, const std::string& path,
                     const std::string& crs);

}  // namespace urban_nav
