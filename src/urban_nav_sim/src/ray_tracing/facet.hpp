// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "world/world.hpp"

namespace urban_nav_sim {

/// One triangle for shading: its plane, and texture coordinates as a linear function of position. One cache line. In
/// the frame of its Part.
struct alignas(64) Facet {
  Eigen::Vector3f corner;  ///< its first vertex, m
  Eigen::Vector3f normal;  ///< unit, outward; zero if the triangle has no area
  Eigen::Vector3f per_s;   ///< gradient of the first texture coordinate in the plane, m/m
  Eigen::Vector3f per_t;   ///< gradient of the second
  Eigen::Vector2f at;      ///< texture coordinates of the corner, m
  std::uint32_t part;      ///< index of Tracer's parts
  std::uint32_t unused;

  /// Returns the texture coordinates of a position in the plane of the triangle.
  Eigen::Vector2f textureAt(const Eigen::Vector3f& place) const {
    const Eigen::Vector3f d = place - corner;
    return at + Eigen::Vector2f(per_s.dot(d), per_t.dot(d));
  }
};
static_assert(sizeof(Facet) == 64, "a facet is one cache line");

/// Returns the facets of a part in the order of its triangles. `index` becomes Facet::part. Throws UserError if a
/// triangle refers to a missing vertex, or if the numbers of vertices and texture coordinates differ.
std::vector<Facet> makeFacets(const Part& part, std::uint32_t index);

}  // namespace urban_nav_sim
