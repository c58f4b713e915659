// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "materials/tile.hpp"

namespace urban_nav_sim {

/// Mask of a card of leaves: each texel has the rank of its leaf, so that leaves fall one by one.
struct Cut {
  int size = 512;                   ///< texels per side, a power of two
  float period = 2.0F;              ///< m
  std::vector<std::uint8_t> ranks;  ///< 0: empty; otherwise 1 ... 255

  bool isThere(const Eigen::Vector2f& at, float leaves) const;
};

struct Leaves {
  std::shared_ptr<const Tile> tile;  ///< mix: colour of each leaf between two colours; tone: lightness
  std::shared_ptr<const Cut> cut;
};

/// Draws `count` leaves of `low` to `high` m length on a square of 2 m.
Leaves drawLeaves(int count, double low, double high, std::uint64_t seed);
/// Draws a dense hedge or shrub: opaque foliage. `blossoms`: share of leaves of the second colour.
std::shared_ptr<const Tile> drawHedge(double blossoms, std::uint64_t seed);
std::shared_ptr<const Tile> drawBark(std::uint64_t seed);

}  // namespace urban_nav_sim
