// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "world/surface_class.hpp"

namespace urban_nav_sim {

/// What a surface looks like, procedurally: evaluated where it is looked up, filtered to the size of what looks.
struct Material {
  std::string name;
  SurfaceClass surface_class = SurfaceClass::Other;
  // ... patterns and noises: the room's own
};

/// A point of a surface as a pixel (or a beam) sees it.
struct Spot {
  Eigen::Vector2f at = Eigen::Vector2f::Zero();     ///< m along the surface (Part::texture, interpolated)
  Eigen::Vector2f per_u = Eigen::Vector2f::Zero();  ///< by how much `at` changes to the pixel on the right, m
  Eigen::Vector2f per_v = Eigen::Vector2f::Zero();  ///< ... and to the one below
  std::uint32_t seed = 0;                           ///< Part::seed
  float wet = 0.0F;                                 ///< Day::wet
};

struct Look {
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.5F);  ///< linear RGB, 0 ... 1
  float infrared = 0.5F;                                     ///< albedo at 905 nm, for lasers
  float gloss = 0.0F;                                        ///< share of light that is mirrored: windows, wet ground
};

Look lookAt(const Material& material, const Spot& spot);
/// Is there anything at this place? Leaves on cards: the rest is cut out. Materials that have no holes say so by `hasHoles`.
bool isThere(const Material& material, const Eigen::Vector2f& at, std::uint32_t seed, float leaves);
bool hasHoles(const Material& material);

}  // namespace urban_nav_sim
