// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// Interpolates between two poses: linear in translation, constant angular rate along the shorter rotation. share = 0
/// gives a, 1 gives b, exactly; other values extrapolate.
Pose interpolate(const Pose& a, const Pose& b, double share);

}  // namespace urban_nav_core
