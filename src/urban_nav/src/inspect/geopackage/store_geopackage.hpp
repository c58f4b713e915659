// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Writes the sessions of a store as layers of a GeoPackage: trajectories, closures, coverage and quality
/// (docs/files.md). `maps`: by readMaps(); `crs`, `control`: as for MapCrs, or `crs` is "local" or empty for the frame
/// `map`. Throws UserError for other values, DataError if a map cannot be georeferenced.
void writeGeoPackage(urban_nav_store::Store& store,
                     const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps, const std::string& path,
                     const std::string& crs, const std::string& control);

}  // namespace urban_nav
