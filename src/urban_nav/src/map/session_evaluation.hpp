// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/context.hpp"

namespace urban_nav {

/// Compares the trajectories of a run, which must be final, with ground truth: that of --truth, or that found in the
/// inputs. Unreadable ground truth costs the comparison, not the map: it is reported as a warning.
std::vector<SessionEvaluations> evaluateSessions(const MapContext& context);

}  // namespace urban_nav
