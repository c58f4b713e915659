// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "urban_nav_core/testing/scene.hpp"

namespace urban_nav_core::testing {

/// A straight street along +x from the origin, road in the middle, houses of different widths on both sides, parked
/// cars (boxes), pavement; ground at z = 0. A camera may drive at |y| < 2.
struct StreetSize {
  double length = 260.0;  ///< m of houses in front of the origin
  double width = 15.0;    ///< m from house to house
};

Scene texturedStreet(const StreetSize& size = {}, std::uint32_t seed = 1);

/// The street with a van ahead in the middle of the road: `ahead` m before a camera that left the origin at `speed`,
/// with a distance that oscillates by a fifth.
std::function<Scene(double t)> streetWithVan(const StreetSize& size, double speed, double ahead,
                                             std::uint32_t seed = 1);

}  // namespace urban_nav_core::testing
