// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "materials/leaf_tiles.hpp"
#include "materials/tile.hpp"
#include "world/surface_class.hpp"

namespace urban_nav_sim {

/// Large-scale variation added to the detail: stains, weathering, mown stripes. Relative to the mean of the tile.
struct Layer {
  std::shared_ptr<const Tile> tile;  ///< null: no layer
  float stretch = 1.0F;              ///< factor of the period of the tile
  Eigen::Vector2f turn =
      Eigen::Vector2f::UnitX();  ///< cosine and sine of a rotation, which decorrelates layer and detail
  Eigen::Vector3f per_tone = Eigen::Vector3f::Zero();  ///< change of albedo per tone
  Eigen::Vector3f per_mix = Eigen::Vector3f::Zero();   ///< change of albedo per mix
};

/// Procedural appearance of a surface, filtered to the footprint of a look-up. A sum of tiles, so a look-up gives the
/// mean over its footprint. Plain data; immutable in use.
struct Material {
  std::string name;
  SurfaceClass surface_class = SurfaceClass::Other;
  std::array<Eigen::Vector3f, 2> colours = {Eigen::Vector3f::Constant(0.5F),
                                            Eigen::Vector3f::Constant(0.5F)};  ///< linear RGB at mix 0 and 1
  std::array<float, 2> infrareds = {0.5F, 0.5F};                               ///< albedo at 905 nm
  std::array<float, 2> glosses = {0.0F, 0.0F};
  std::array<float, 2> glass = {0.0F, 0.0F};           ///< share through which a room is seen at mix 0 and 1: windows
  Eigen::Vector3f per_tone = Eigen::Vector3f::Zero();  ///< change of albedo per tone of the detail
  float infrared_per_tone = 0.0F;
  std::shared_ptr<const Tile> detail;  ///< null: uniform colour
  float stretch = 1.0F;                ///< factor of the period of the detail
  bool anchored = false;               ///< the detail begins at (0, 0) for all seeds: windows
  std::array<Layer, 2> layers;
  std::shared_ptr<const Cut> cut;  ///< null: no holes
  float soaks = 0.4F;              ///< decrease of albedo when wet, a share
  float shines = 0.0F;             ///< gloss when wet
};

/// A point of a surface with the footprint of a pixel or beam.
struct MaterialSample {
  Eigen::Vector2f at = Eigen::Vector2f::Zero();     ///< m along the surface (Part::texture, interpolated)
  Eigen::Vector2f per_u = Eigen::Vector2f::Zero();  ///< change of `at` to the pixel on the right, m
  Eigen::Vector2f per_v = Eigen::Vector2f::Zero();  ///< change of `at` to the pixel below, m
  std::uint32_t seed = 0;                           ///< Part::seed
  float wet = 0.0F;                                 ///< Day::wet
};

struct Appearance {
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.5F);  ///< linear RGB, 0 ... 1
  float infrared = 0.5F;                                     ///< albedo at 905 nm, for lasers
  float gloss = 0.0F;                                        ///< share of specular reflection: windows, wet ground
  float glass = 0.0F;                                        ///< share through which a room is seen
};

Appearance lookAt(const Material& material, const MaterialSample& spot);
/// Returns whether the material is present at a position; cards of leaves are cut out. `hasHoles` is false for
/// materials without holes.
bool isThere(const Material& material, const Eigen::Vector2f& at, std::uint32_t seed, float leaves);
bool hasHoles(const Material& material);

}  // namespace urban_nav_sim
