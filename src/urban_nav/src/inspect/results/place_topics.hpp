// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "convert/bag_writer.hpp"
#include "inspect/results/recorded_map.hpp"

namespace urban_nav {

/// Writes position and thumbnail of each place of place recognition at its stamp. No effect without places.
void writePlaceTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording);

}  // namespace urban_nav
