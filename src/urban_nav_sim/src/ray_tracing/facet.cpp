// SPDX-License-Identifier: BSD-3-Clause
#include "ray_tracing/facet.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

void checkIndices(const Part& part) {
  if (part.texture.size() != part.vertices.size()) {
    throw urban_nav_core::UserError("world", "a part with unequal numbers of vertices and texture coordinates", "");
  }
  for (const auto& triangle : part.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= part.vertices.size()) {
      throw urban_nav_core::UserError("world", "a triangle of vertices that are not there", "");
    }
  }
}

}  // namespace

std::vector<Facet> makeFacets(const Part& part, std::uint32_t index) {
  checkIndices(part);
  std::vector<Facet> facets;
  facets.reserve(part.triangles.size());
  for (const auto& triangle : part.triangles) {
    const Eigen::Vector3d a = part.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d ab = part.vertices[triangle[1]].cast<double>() - a;
    const Eigen::Vector3d ac = part.vertices[triangle[2]].cast<double>() - a;
    const Eigen::Vector2d at = part.texture[triangle[0]].cast<double>();
    const Eigen::Vector2d st_b = part.texture[triangle[1]].cast<double>() - at;
    const Eigen::Vector2d st_c = part.texture[triangle[2]].cast<double>() - at;
    const Eigen::Vector3d across = ab.cross(ac);
    const double area2 = across.squaredNorm();
    Facet facet{};
    facet.corner = a.cast<float>();
    facet.at = at.cast<float>();
    facet.part = index;
    if (area2 > 0.0) {
      // Dual basis of the edges in the plane: p = s ab + t ac has s = to_b . p, t = to_c . p.
      const Eigen::Vector3d to_b = ac.cross(across) / area2, to_c = across.cross(ab) / area2;
      facet.normal = (across / std::sqrt(area2)).cast<float>();
      facet.per_s = (to_b * st_b.x() + to_c * st_c.x()).cast<float>();
      facet.per_t = (to_b * st_b.y() + to_c * st_c.y()).cast<float>();
    } else {
      facet.normal = facet.per_s = facet.per_t = Eigen::Vector3f::Zero();
    }
    facets.push_back(facet);
  }
  return facets;
}

}  // namespace urban_nav_sim
