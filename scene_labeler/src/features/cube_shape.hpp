// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "features/cube_moments.hpp"

namespace scene_labeler {

/// Shape of the cubes around a cube; unknown with fewer than three cubes.
struct CubeShape {
  bool is_known = false;
  float linearity = 0.0F, planarity = 0.0F, scatter = 0.0F;  ///< from deviations l1 >= l2 >= l3
  float normal_z = 0.0F, tangent_z = 0.0F;                   ///< absolute
  float roughness = 0.0F;                                    ///< deviation along the normal, m
  float vertical = 0.0F;                                     ///< deviation in height, relative to the edge
  float occupied = 0.0F;                                     ///< share of the 27 cubes
  Eigen::Vector3f mean = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::UnitZ();

  bool isPlane() const;
};

constexpr std::size_t kShapeValues = 10;  ///< features per level

/// Returns the shape of a cube and its neighbours.
CubeShape shapeAround(const CubeLevel& level, std::size_t cube);

/// Writes the kShapeValues features of a point in a cube of this shape. `point`: relative to the origin of the cubes.
/// Unknown values are unchanged.
void writeShape(const CubeShape& shape, const Eigen::Vector3f& point, float edge, float* out);

}  // namespace scene_labeler
