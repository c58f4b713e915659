// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/context.hpp"
#include "urban_nav_trust/assessment.hpp"

namespace urban_nav {

/// Trust in the map of a run.
struct TrustRun {
  urban_nav_trust::TestResults results;  ///< all sessions
  /// All poses that are written, in the order of trajectory.tum and trajectory_N.tum.
  std::vector<urban_nav_trust::FrameTrust> frames;
  urban_nav_trust::MapTrust map;
};

/// Runs the tests on the sessions of a run whose trajectories are final, and assesses their frames.
TrustRun assessTrust(MapContext& context, const urban_nav_trust::Parameters& parameters);

}  // namespace urban_nav
