// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "map/context.hpp"

namespace urban_nav {

/// Extent of the sessions of a run.
struct RunTotals {
  std::int64_t frames = 0;  ///< stereo frames, dropped ones included
  double seconds = 0.0;     ///< from first to last smoothed frame, summed over sessions
  double distance_m = 0.0;  ///< along the smoothed trajectories, without noise at standstill
};
RunTotals totals(const std::vector<const SessionOdometry*>& runs);
/// Returns the totals of the sessions of this run, without previous ones.
RunTotals ownTotals(const MapContext& context);

}  // namespace urban_nav
