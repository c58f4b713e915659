// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "materials/tile.hpp"

namespace urban_nav_sim {

/// Courses of blocks with joints between: bricks, ashlar, paving slabs, slates, boards.
struct Bond {
  int size = 1024;       ///< texels per side
  float period = 2.25F;  ///< m
  float course_low = 0.075F,
        course_high = 0.075F;  ///< height of a course, m; if equal, every second one is shifted by half a block
  float block_low = 0.225F, block_high = 0.225F;  ///< length of a block, m
  float joint = 0.01F;                            ///< width, m
  float wobble = 0.0F;                            ///< deviation of edges from straight, m
  float block_tone = 0.25F;                       ///< standard deviation between blocks
  float grain = 0.12F;                            ///< standard deviation within a block, at 5 mm to 10 cm
  float pits = 0.0F;                              ///< dark weathered spots
  float shade = 0.1F;                             ///< darkening at the lower edge of a block
  bool upright = false;                           ///< vertical courses (boards)
  std::uint64_t seed = 1;
};

/// mix: joint; tone: blocks and grain.
std::shared_ptr<const Tile> drawBond(const Bond& bond);

/// Draws irregular stones in mortar (`stones` along a period of `period` m).
std::shared_ptr<const Tile> drawRubble(int stones, float period, std::uint64_t seed);

/// Draws a window of `columns` x `rows` panes that fills the period of the tile (2 m). mix: frame and glazing bars;
/// tone: the interior.
std::shared_ptr<const Tile> drawWindow(int columns, int rows, std::uint64_t seed);

}  // namespace urban_nav_sim
