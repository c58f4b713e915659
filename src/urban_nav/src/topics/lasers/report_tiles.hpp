// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Name of the folder of the finer levels next to a report.
constexpr const char* kReportTiles = "report_tiles";

/// Writes the tiles of a map as scripts into `folder`, in place of those of an earlier run, which the report next to it
/// loads when they come into view. `number`: of the map's view in the report. `first`: first session of the map.
/// Returns the list of the tiles for the report (tilesAsJson()); empty if the store has none.
std::string writeReportTiles(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                             const std::string& folder, std::size_t number);

/// Removes the tiles of a view of an earlier run.
void removeReportTiles(const std::string& folder, std::size_t number);

}  // namespace urban_nav
