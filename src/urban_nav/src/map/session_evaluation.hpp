// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/context.hpp"

namespace urban_nav {

/// Compares the final trajectories of a run with ground truth: that of --truth, or that found in the inputs. Unreadable
/// ground truth is reported as a warning and not compared.
std::vector<SessionEvaluations> evaluateSessions(const MapContext& context);

}  // namespace urban_nav
