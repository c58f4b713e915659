// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// Between two poses: the translation on a straight line, the rotation at constant rate the shorter way round. share =
/// 0 gives a, 1 gives b, exactly; beyond, the motion goes on.
Pose interpolate(const Pose& a, const Pose& b, double share);

}  // namespace urban_nav_core
