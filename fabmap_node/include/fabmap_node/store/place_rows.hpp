// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "fabmap_node/recognition/place_describer.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace fabmap_node {

/// Returns the row of an observation. `model`: hash of the model of its words.
urban_nav_store::StoredPlace toStoredPlace(const urban_nav_store::SessionId& session, urban_nav_core::StampNs stamp,
                                           const PlaceDescription& description, const std::string& model);
/// Returns the observation of a row. Throws DataError naming the row if it is damaged, or its words are not those of a
/// vocabulary of this size.
PlaceDescription toPlaceDescription(const urban_nav_store::StoredPlace& row, std::size_t vocabulary_size);

/// Returns a small JPEG of the images side by side: 64 px high, at most 6 kB; empty if there is no image.
std::string placeThumbnail(const std::vector<urban_nav_core::ImageView>& images);

}  // namespace fabmap_node
