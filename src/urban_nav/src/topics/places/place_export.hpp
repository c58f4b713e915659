// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

struct ExportedPlaces {
  std::int64_t places = 0, thumbnails = 0;
  std::vector<std::string> files;  ///< places.csv, then models; thumbnails are not listed
};

/// Writes the places of the given sessions into a new folder: `places.csv`, a row per place with its pose in `map`
/// (empty outside the trajectory) and the name of its thumbnail (docs/files.md); `thumbnails/`; and the models of their
/// words, for `places query`. Throws DataError without places, UserError if a file cannot be written.
ExportedPlaces exportPlaces(urban_nav_store::Store& store,
                            const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps,
                            const std::string& folder);

}  // namespace urban_nav
