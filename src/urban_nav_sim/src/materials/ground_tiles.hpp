// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "materials/tile.hpp"

namespace urban_nav_sim {

/// What lies on the ground. In all of them mix 0 and 1 are the two colours of the stuff, tone its light and shade.
std::shared_ptr<const Tile> drawGrass(std::uint64_t seed);    ///< blades in tufts; mix: dry
std::shared_ptr<const Tile> drawGravel(std::uint64_t seed);   ///< pebbles of 1-4 cm; mix: the gaps
std::shared_ptr<const Tile> drawAsphalt(std::uint64_t seed);  ///< chippings in bitumen, cracks; mix: chippings
std::shared_ptr<const Tile> drawSoil(
    std::uint64_t seed);  ///< trodden earth with stones and litter; mix: stones and litter

/// Two clouds without a scale of their own (6 octaves), for stains and weathering: tone and mix - 0.5 are independent,
/// tone of standard deviation 0.3.
std::shared_ptr<const Tile> drawClouds(std::uint64_t seed);
/// The same drawn out downwards: what rain leaves on walls.
std::shared_ptr<const Tile> drawStreaks(std::uint64_t seed);

/// Plaster, paint, stone that is smooth: little at all scales; mix: hairline cracks and chips.
std::shared_ptr<const Tile> drawPlaster(std::uint64_t seed);

}  // namespace urban_nav_sim
