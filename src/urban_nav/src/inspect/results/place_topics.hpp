// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "convert/bag_writer.hpp"
#include "inspect/results/recorded_map.hpp"

namespace urban_nav {

/// Writes where each place was that place recognition has used, and the thumbnail of each place, at their stamps.
/// Nothing without places.
void writePlaceTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording);

}  // namespace urban_nav
