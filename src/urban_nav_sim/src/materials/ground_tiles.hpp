// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "materials/tile.hpp"

namespace urban_nav_sim {

/// Ground surfaces. Mix 0 and 1 are the two colours of the material, tone is its lightness.
std::shared_ptr<const Tile> drawGrass(std::uint64_t seed);    ///< blades in tufts; mix: dry
std::shared_ptr<const Tile> drawGravel(std::uint64_t seed);   ///< pebbles of 1-4 cm; mix: gaps
std::shared_ptr<const Tile> drawAsphalt(std::uint64_t seed);  ///< chippings in bitumen, cracks; mix: chippings
std::shared_ptr<const Tile> drawSoil(
    std::uint64_t seed);  ///< trodden earth with stones and litter; mix: stones and litter

/// Two independent fractal noises (6 octaves), tone and mix - 0.5, for stains and weathering; tone has standard
/// deviation 0.3.
std::shared_ptr<const Tile> drawClouds(std::uint64_t seed);
/// The same stretched vertically: streaks of rain on walls.
std::shared_ptr<const Tile> drawStreaks(std::uint64_t seed);

/// Plaster, paint, smooth stone: low contrast at all scales; mix: hairline cracks and chips.
std::shared_ptr<const Tile> drawPlaster(std::uint64_t seed);

}  // namespace urban_nav_sim
