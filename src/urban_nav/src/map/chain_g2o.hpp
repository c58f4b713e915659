// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "map/session_odometry.hpp"

namespace urban_nav {

/// Returns graph.g2o of odometry only: one pose per frame and one edge per step; information in g2o's tangent.
std::string chainG2o(const SessionOdometry& run);

}  // namespace urban_nav
