// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "urban_nav_core/testing/scene.hpp"

namespace urban_nav_core::testing {

/// Room with a few boxes and pillars, floor at z = 0, centred at the origin. Within `freeX`, `freeY` of the centre
/// there is no furniture, so a camera may be anywhere.
struct RoomSize {
  double x = 12.0, y = 8.0, z = 3.0;  ///< m, at least 6 x 4 x 2
  double freeX() const { return 0.5 * x - 1.6; }
  double freeY() const { return 0.5 * y - 1.5; }
};

Scene texturedRoom(const RoomSize& size = {}, std::uint32_t seed = 1);

}  // namespace urban_nav_core::testing
