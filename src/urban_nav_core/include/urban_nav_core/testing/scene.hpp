// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/testing/texture.hpp"

namespace urban_nav_core::testing {

/// Rectangle, visible from the side that a x b points to.
struct Rectangle {
  Vector3d corner = Vector3d::Zero();  ///< in world, m
  Vector3d a = Vector3d::UnitX();      ///< unit, along the texture's x
  Vector3d b = Vector3d::UnitY();      ///< unit, along the texture's y, at a right angle to a
  double size_a = 1.0, size_b = 1.0;   ///< m
  std::shared_ptr<const Texture> texture;
  double texture_x = 0.0, texture_y = 0.0;  ///< texture coordinates of the corner, m
  double shade = 1.0;                       ///< factor on the texture: illumination of this side
};

/// First intersection of a ray.
struct Hit {
  double distance = 0.0;  ///< in units of the length of the direction
  std::size_t rectangle = 0;
};

/// Textured rectangles in a world frame whose z points up. Plain data.
struct Scene {
  std::vector<Rectangle> rectangles;
  double background = 215.0;  ///< grey level where there is no rectangle: sky

  /// Adds the five or six outer faces of a box. T_world_box: to the centre of its floor, x along `size.x()`.
  void addBox(const Pose& T_world_box, const Vector3d& size, const std::shared_ptr<const Texture>& texture,
              double shift);
  /// Returns the first intersection, computed exactly from the plane equations.
  std::optional<Hit> trace(const Vector3d& origin, const Vector3d& direction) const;
};

}  // namespace urban_nav_core::testing
