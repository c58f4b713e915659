// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/scene.hpp"

namespace urban_nav_core::testing {

void Scene::addBox(const Pose& T_world_box, const Vector3d& size, const std::shared_ptr<const Texture>& texture,
                   double shift) {
  const Vector3d half = 0.5 * size;
  const auto add = [&](const Vector3d& corner, const Vector3d& a, const Vector3d& b, double size_a, double size_b,
                       double shade) {
    Rectangle face;
    face.corner = T_world_box * corner;
    face.a = T_world_box.q() * a;
    face.b = T_world_box.q() * b;
    face.size_a = size_a;
    face.size_b = size_b;
    face.texture = texture;
    face.texture_x = shift + 3.1 * static_cast<double>(rectangles.size());
    face.texture_y = 1.7 * shift;
    face.shade = shade;
    rectangles.push_back(face);
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  add({-half.x(), -half.y(), 0.0}, x, z, size.x(), size.z(), 0.9);
  add({half.x(), half.y(), 0.0}, -x, z, size.x(), size.z(), 0.75);
  add({half.x(), -half.y(), 0.0}, y, z, size.y(), size.z(), 1.0);
  add({-half.x(), half.y(), 0.0}, -y, z, size.y(), size.z(), 0.65);
  add({-half.x(), -half.y(), size.z()}, x, y, size.x(), size.y(), 1.15);
}

std::optional<Hit> Scene::trace(const Vector3d& origin, const Vector3d& direction) const {
  std::optional<Hit> nearest;
  for (std::size_t i = 0; i < rectangles.size(); ++i) {
    const Rectangle& r = rectangles[i];
    const Vector3d normal = r.a.cross(r.b);
    const double slope = normal.dot(direction);
    if (slope >= 0.0) continue;
    const double distance = normal.dot(r.corner - origin) / slope;
    if (distance <= 0.0 || (nearest && distance >= nearest->distance)) continue;
    const Vector3d p = origin + distance * direction - r.corner;
    const double along_a = p.dot(r.a), along_b = p.dot(r.b);
    if (along_a >= 0.0 && along_b >= 0.0 && along_a <= r.size_a && along_b <= r.size_b) nearest = Hit{distance, i};
  }
  return nearest;
}

}  // namespace urban_nav_core::testing
