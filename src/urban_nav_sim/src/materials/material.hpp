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

/// Something large that comes on top of the detail: stains, weathering, mown stripes. Taken relative to the tile's
/// mean.
struct Layer {
  std::shared_ptr<const Tile> tile;  ///< none: no such layer
  float stretch = 1.0F;              ///< the tile's period is so many times as long
  Eigen::Vector2f turn =
      Eigen::Vector2f::UnitX();  ///< cosine and sine; what lies turned does not repeat in step with the detail
  Eigen::Vector3f per_tone = Eigen::Vector3f::Zero();  ///< change of the albedo per tone
  Eigen::Vector3f per_mix = Eigen::Vector3f::Zero();   ///< ... and per mix
};

/// What a surface looks like, procedurally: evaluated where it is looked up, filtered to the size of what looks.
/// Everything is a sum of tiles, so the mean over a footprint is the look-up with that footprint. Plain data; immutable
/// in use.
struct Material {
  std::string name;
  SurfaceClass surface_class = SurfaceClass::Other;
  std::array<Eigen::Vector3f, 2> colours = {Eigen::Vector3f::Constant(0.5F),
                                            Eigen::Vector3f::Constant(0.5F)};  ///< linear RGB at mix 0 and 1
  std::array<float, 2> infrareds = {0.5F, 0.5F};                               ///< albedo at 905 nm
  std::array<float, 2> glosses = {0.0F, 0.0F};
  Eigen::Vector3f per_tone = Eigen::Vector3f::Zero();  ///< change of the albedo per tone of the detail
  float infrared_per_tone = 0.0F;
  std::shared_ptr<const Tile> detail;  ///< none: of one colour
  float stretch = 1.0F;                ///< the detail's period is so many times as long
  bool anchored = false;               ///< the detail begins at (0, 0) whatever the seed: windows
  std::array<Layer, 2> layers;
  std::shared_ptr<const Cut> cut;  ///< none: no holes
  float soaks = 0.4F;              ///< share of light that it loses when wet
  float shines = 0.0F;             ///< gloss that it has when wet
};

/// A point of a surface as a pixel (or a beam) sees it.
struct MaterialSample {
  Eigen::Vector2f at = Eigen::Vector2f::Zero();     ///< m along the surface (Part::texture, interpolated)
  Eigen::Vector2f per_u = Eigen::Vector2f::Zero();  ///< by how much `at` changes to the pixel on the right, m
  Eigen::Vector2f per_v = Eigen::Vector2f::Zero();  ///< ... and to the one below
  std::uint32_t seed = 0;                           ///< Part::seed
  float wet = 0.0F;                                 ///< Day::wet
};

struct Appearance {
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.5F);  ///< linear RGB, 0 ... 1
  float infrared = 0.5F;                                     ///< albedo at 905 nm, for lasers
  float gloss = 0.0F;                                        ///< share of light that is mirrored: windows, wet ground
};

Appearance lookAt(const Material& material, const MaterialSample& spot);
/// Is there anything at this place? Leaves on cards: the rest is cut out. Materials that have no holes say so by
/// `hasHoles`.
bool isThere(const Material& material, const Eigen::Vector2f& at, std::uint32_t seed, float leaves);
bool hasHoles(const Material& material);

}  // namespace urban_nav_sim
