// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "convert/bag_writer.hpp"
#include "inspect/results/recorded_map.hpp"

namespace urban_nav {

/// Writes the closures between poses of a map with their verdicts, each at its later pose, and the lines between their
/// poses as markers at the first pose. No effect without closures.
void writeClosureTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording);

}  // namespace urban_nav
