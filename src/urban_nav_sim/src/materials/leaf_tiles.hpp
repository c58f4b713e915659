// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "materials/tile.hpp"

namespace urban_nav_sim {

/// Where a card of leaves is cut out: each texel has the rank of the leaf that is there, so that leaves fall one by
/// one.
struct Cut {
  int size = 512;                   ///< texels a side, a power of two
  float period = 2.0F;              ///< m
  std::vector<std::uint8_t> ranks;  ///< 0: nothing there; else 1 ... 255

  bool isThere(const Eigen::Vector2f& at, float leaves) const;
};

struct Leaves {
  std::shared_ptr<const Tile> tile;  ///< mix: between two colours from leaf to leaf; tone: light and shade
  std::shared_ptr<const Cut> cut;
};

/// Leaves of `low` to `high` m length, `count` of them on a square of 2 m.
Leaves drawLeaves(int count, double low, double high, std::uint64_t seed);
/// A dense hedge or shrub: opaque foliage. `blossoms`: share of them that are wholly of the second colour.
std::shared_ptr<const Tile> drawHedge(double blossoms, std::uint64_t seed);
std::shared_ptr<const Tile> drawBark(std::uint64_t seed);

}  // namespace urban_nav_sim
