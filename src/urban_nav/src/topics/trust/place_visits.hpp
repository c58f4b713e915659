// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/context.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_trust/free_space_comparison.hpp"

namespace urban_nav {

/// Two visits of one place.
struct VisitPair {
  urban_nav_core::StampNs earlier = 0, later = 0;
};
/// Returns pairs of poses within 3 m of each other, more than 20 s and 24 m of path apart. The later poses are at least
/// a length of two local clouds apart, so that no two pairs share walls of the later visit. At most 12, evenly spread.
std::vector<VisitPair> findVisits(const urban_nav_core::Trajectory& T_map_base);

/// Counts the walls of two clouds, with origins, that are at walls of the other one, and those that beams of the other
/// one pass through. `T_a_b`: pose of the later cloud in the axes of the earlier one.
urban_nav_trust::PlaceVisits compareVisits(const urban_nav_core::PointCloud& a, const urban_nav_core::PointCloud& b,
                                           const urban_nav_core::Pose& T_a_b);

/// Tests the visits of a session that the map places accurately enough, with the clouds of its lasers. `session`:
/// number over all sessions.
void compareFreeSpace(const MapContext& context, std::size_t session, urban_nav_trust::TestResults& results);

}  // namespace urban_nav
