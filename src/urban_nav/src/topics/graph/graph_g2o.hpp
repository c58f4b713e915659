// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "topics/graph/graph_run.hpp"

namespace urban_nav {

/// Returns graph.g2o: all sessions at their relaxed poses, odometry and accepted closures.
std::string graphG2o(const GraphRun& run);

}  // namespace urban_nav
