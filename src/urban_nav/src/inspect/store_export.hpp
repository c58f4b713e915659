// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// The poses of one map of a store as other programs read them. Each gives the bytes that `map` wrote from the same
/// poses.

/// base_link in `map`, sessions one after another. UserError where sessions overlap in time: the format has one pose a
/// stamp.
std::string exportTum(const urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map);

/// The left optical frame relative to the first pose, a line for every stereo frame; one without a pose repeats the one
/// before. UserError where the store does not know where the camera stands.
std::string exportKitti(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map);

struct ExportedGraph {
  std::string text;
  std::int64_t vertices = 0, edges = 0;
  std::int64_t left_out = 0;  ///< edges that are rejected or wait
  std::int64_t outside = 0;   ///< edges to poses of sessions that are not exported
};
/// Every node, and every accepted edge between them but those without information; the first vertex of each map is
/// fixed.
ExportedGraph exportG2o(urban_nav_store::Store& store,
                        const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps);

}  // namespace urban_nav
