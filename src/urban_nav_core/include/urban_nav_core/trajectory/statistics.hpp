// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// Returns the length of a path, m, without the noise at standstill: a position counts once it is `step` m from the
/// last counted one.
double travelledLength(const std::vector<Vector3d>& positions, double step = 0.05);

/// Returns the value below which `share` (0...1) of the values lie; 0 for no values.
double quantile(std::vector<double> values, double share);

}  // namespace urban_nav_core
