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

/// Writes the places of the given sessions into a folder, which is made: `places.csv`, a row per place with its pose in
/// `map` (empty outside the trajectory) and the name of its thumbnail (docs/files.md); `thumbnails/`; and the models
/// whose words they are, for `places query`. Throws DataError if there is no place, UserError if a file cannot be
/// written.
ExportedPlaces exportPlaces(urban_nav_store::Store& store,
                            const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps,
                            const std::string& folder);

}  // namespace urban_nav
