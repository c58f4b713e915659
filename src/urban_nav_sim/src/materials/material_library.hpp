// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>

#include "materials/material.hpp"
#include "noise/hash.hpp"

namespace urban_nav_sim {

/// Materials of worlds.
enum class MaterialKind {
  Ashlar,
  Rubble,
  Brick,
  DarkBrick,
  Render,
  Slate,
  RoofTile,  // walls and roofs
  Slabs,
  Setts,
  Gravel,
  Asphalt,
  Lawn,
  Meadow,
  Soil,
  Kerb,
  RoadPaint,  // what lies on the ground
  Hedge,
  Shrub,
  Flowers,
  Leaves,
  SmallLeaves,
  Bark,
  Sash,
  Casement,
  ShopWindow,
  Door,
  Boards,
  PaintedWood,
  CarPaint,
  CarGlass,
  Rubber,
  Iron,
  Cloth,
  Skin
};

/// Makes materials; draws each tile once, on first use. Not thread-safe. The same seed gives the same materials.
class MaterialLibrary {
 public:
  explicit MaterialLibrary(std::uint64_t seed) : seed_(seed) {}
  /// `variant`: colour variant of the material (0, 1, 2, ...).
  Material make(MaterialKind stuff, std::uint64_t variant = 0);

 private:
  enum class Drawing {
    Ashlar,
    Rubble,
    Brick,
    Slate,
    RoofTile,
    Slabs,
    Setts,
    Gravel,
    Asphalt,
    Grass,
    Soil,
    Clouds,
    Streaks,
    Plaster,
    Hedge,
    Bark,
    Sash,
    Casement,
    Shop,
    Boards,
    Flowers
  };
  std::shared_ptr<const Tile> tile(Drawing drawing);
  std::shared_ptr<const Tile> draw(Drawing drawing) const;
  Material wall(MaterialKind stuff, Draw& variation);
  Material ground(MaterialKind stuff, Draw& variation);
  Material plant(MaterialKind stuff, Draw& variation);
  Material made(MaterialKind stuff, Draw& variation);
  Layer clouds(float stretch, float turn, const Eigen::Vector3f& per_tone, const Eigen::Vector3f& per_mix);
  Layer streaks(float stretch, const Eigen::Vector3f& per_tone);

  std::uint64_t seed_;
  std::map<Drawing, std::shared_ptr<const Tile>> tiles_;
  std::array<Leaves, 2> leaves_;
};

}  // namespace urban_nav_sim
