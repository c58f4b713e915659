// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Export of the poses of one map of a store. The output is identical to that of `map` for the same poses.

/// Returns the poses of base_link in `map` as TUM, sessions one after another. Throws UserError if sessions overlap in
/// time, since the format has one pose per stamp.
std::string exportTum(const urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map);

/// Returns the poses of the left optical frame relative to the first one as KITTI, a line per stereo frame; a frame
/// without a pose repeats the previous one. Throws UserError if the store has no extrinsics of the camera.
std::string exportKitti(urban_nav_store::Store& store, const std::vector<urban_nav_store::StoredTrajectory>& map);

struct ExportedGraph {
  std::string text;
  std::int64_t vertices = 0, edges = 0;
  std::int64_t left_out = 0;  ///< rejected and waiting edges
  std::int64_t outside = 0;   ///< edges to poses of sessions that are not exported
};
/// Returns all nodes and all accepted edges with information between them as g2o; the first vertex of each map is
/// fixed.
ExportedGraph exportG2o(urban_nav_store::Store& store,
                        const std::vector<std::vector<urban_nav_store::StoredTrajectory>>& maps);

}  // namespace urban_nav
