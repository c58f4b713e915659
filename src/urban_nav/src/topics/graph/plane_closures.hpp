// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laser_mapper/parameters.hpp"
#include "laser_mapper/quality/plane_constraints.hpp"
#include "topics/graph/graph_run.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Finds constraints between poses of a relaxed graph from planes measured by the lasers in several passes, in each of
/// its maps. `ids`: store keys of run.sessions. Uses a temporary file next to the store. `cloud_half_length`: of the
/// clouds of ICP closures, m along the path; the information that an accepted ICP closure has from the same beams is
/// removed from the constraints, so that it is not counted twice. Throws the errors of the store.
PlaneClosures findPlaneClosures(const laser_mapper::Parameters& parameters, urban_nav_store::Store& store,
                                const std::vector<urban_nav_store::SessionId>& ids, const GraphRun& run,
                                double cloud_half_length);

}  // namespace urban_nav
