// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth/cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "ground_truth/route_distance.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace urban_nav_sim {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

constexpr double kRadius = 30.0;   // m
constexpr float kSpacing = 0.05F;  // m
constexpr double kSunk = 0.3;  // m: walls extend below the ground; the land around a site is visible and 0.15 m lower
constexpr std::size_t kRowBytes = 3 * sizeof(float) + 1;

/// Calls point(p, class) for each point, in a fixed order.
template <typename Point>
void forEachPoint(const World& world, const RouteDistance& near, const Point& point) {
  for (const Part& part : world.parts) {
    const Material& material = world.materials[part.material];
    const bool holes = hasHoles(material);
    for (const auto& triangle : part.triangles) {
      const Vector3f &a = part.vertices[triangle[0]], &b = part.vertices[triangle[1]], &c = part.vertices[triangle[2]];
      const Vector3f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
      if (!near.touches(low.head<2>(), high.head<2>())) continue;
      sampleTriangle(a, b, c, kSpacing, [&](const Vector3f& w) {
        const Vector3f p = w[0] * a + w[1] * b + w[2] * c;
        if (!near.has(p.x(), p.y())) return;
        if (world.ground && p.z() < world.ground(p.x(), p.y()) - kSunk) return;
        if (holes) {
          const Vector2f at =
              w[0] * part.texture[triangle[0]] + w[1] * part.texture[triangle[1]] + w[2] * part.texture[triangle[2]];
          if (!isThere(material, at, part.seed, world.day.leaves)) return;
        }
        point(p, material.surface_class);
      });
    }
  }
}

}  // namespace

void sampleTriangle(const Vector3f& a, const Vector3f& b, const Vector3f& c, float apart,
                    const std::function<void(const Vector3f&)>& place) {
  // Rows parallel to the longest side, up to the opposite corner.
  const std::array<const Vector3f*, 3> corner = {&a, &b, &c};
  std::size_t first = 0;
  float longest = -1.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const float length = (*corner[(i + 1) % 3] - *corner[i]).norm();
    if (length > longest) longest = length, first = i;
  }
  const std::size_t second = (first + 1) % 3, third = (first + 2) % 3;
  if (!(longest > 0.0F)) return;
  const Vector3f side = *corner[second] - *corner[first];
  const float height = side.cross(*corner[third] - *corner[first]).norm() / longest;
  const int rows = std::max(1, static_cast<int>(std::ceil(height / apart)));
  for (int row = 0; row <= rows; ++row) {
    const float up = static_cast<float>(row) / static_cast<float>(rows);
    const int steps = static_cast<int>(std::ceil(longest * (1.0F - up) / apart));
    for (int step = 0; step <= steps; ++step) {
      const float along = steps == 0 ? 0.0F : static_cast<float>(step) / static_cast<float>(steps);
      Vector3f weights;
      weights[static_cast<Eigen::Index>(third)] = up;
      weights[static_cast<Eigen::Index>(second)] = along * (1.0F - up);
      weights[static_cast<Eigen::Index>(first)] = (1.0F - along) * (1.0F - up);
      place(weights);
    }
  }
}

void writeCloud(const std::string& path, const World& world, const Motion& motion) {
  const RouteDistance near(motion, kRadius);
  std::size_t count = 0;
  forEachPoint(world, near, [&count](const Vector3f&, SurfaceClass) { ++count; });
  urban_nav_core::AtomicFile file(path);
  using urban_nav_core::PlyType;
  file.write(urban_nav_core::plyHeader(
      {{{"x", PlyType::Float}, {"y", PlyType::Float}, {"z", PlyType::Float}, {"class", PlyType::UChar}},
       {"m, frame of trajectory.tum; class: 0 other, 1 grass, 2 paved, 3 dirt path, 4 textured wall, 5 smooth wall, "
        "6 foliage, 7 vehicle"}},
      count));
  forEachPoint(world, near, [&file](const Vector3f& p, SurfaceClass surface_class) {
    std::array<char, kRowBytes> row;
    std::memcpy(row.data(), p.data(), 3 * sizeof(float));
    row.back() = static_cast<char>(surface_class);
    file.write(std::string_view(row.data(), row.size()));
  });
  file.commit();
}

}  // namespace urban_nav_sim
