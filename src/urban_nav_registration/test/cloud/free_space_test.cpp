// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/cloud/free_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_registration {
namespace {

using Eigen::Vector3f;
using urban_nav_core::PointCloud;
using urban_nav_core::testing::Dice;

/// A robot that drives 8 m along x in a corridor with walls at y = -5 and 5, with a pillar of half a metre at x = 4, y
/// = 2. The space beyond pillar and walls is unobserved.
PointCloud corridor() {
  PointCloud cloud;
  for (int scan = 0; scan < 160; ++scan) {
    const Vector3f origin(0.05F * static_cast<float>(scan), 0.0F, 1.0F);
    for (int beam = 0; beam < 360; ++beam) {
      const float angle = static_cast<float>(M_PI) / 180.0F * static_cast<float>(beam);
      for (const float slope : {0.0F, 0.1F}) {
        const Vector3f along = Vector3f(std::cos(angle), std::sin(angle), slope).normalized();
        float range = std::abs(along.y()) > 0.2F ? 5.0F / std::abs(along.y()) : std::numeric_limits<float>::infinity();
        for (float r = 0.0F; r < range; r += 0.02F) {
          const Vector3f at = origin + r * along;
          if (at.y() > 5.0F || r > 40.0F) break;
          if (std::abs(at.x() - 4.0F) < 0.25F && std::abs(at.y() - 2.0F) < 0.25F) range = r;
        }
        if (!std::isfinite(range)) continue;
        cloud.points.push_back(origin + range * along);
        cloud.origins.push_back(origin);
      }
    }
  }
  return cloud;
}

TEST(FreeSpace, IsWhereBeamsWentThroughAndNothingElse) {
  const FreeSpace space(corridor(), 0.5F);
  Dice dice(1);
  int free = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3f inside(static_cast<float>(dice.uniform(1.0, 7.0)), static_cast<float>(dice.uniform(-3.0, 0.5)),
                          1.1F);
    free += space.isFree(inside) ? 1 : 0;
    const float side = dice.chance(0.5) ? 1.0F : -1.0F;
    const Vector3f hidden(static_cast<float>(dice.uniform(0.0, 8.0)), side * static_cast<float>(dice.uniform(5.0, 9.0)),
                          1.1F);
    EXPECT_FALSE(space.isFree(hidden)) << hidden.transpose();
    const Vector3f at_wall(static_cast<float>(dice.uniform(0.0, 8.0)),
                           side * static_cast<float>(dice.uniform(4.6, 5.0)), 1.1F);
    EXPECT_FALSE(space.isFree(at_wall)) << at_wall.transpose();
    const Vector3f above(inside.x(), inside.y(), static_cast<float>(dice.uniform(4.0, 9.0)));
    EXPECT_FALSE(space.isFree(above)) << above.transpose();
  }
  EXPECT_GT(free, 1950);
  EXPECT_FALSE(space.isFree({4.0F, 2.0F, 1.1F})) << "the pillar";
  EXPECT_TRUE(space.isFree({2.0F, 2.0F, 1.1F})) << "beside it";
}

TEST(FreeSpace, IsUnknownWithoutBeams) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  PointCloud cloud;
  EXPECT_FALSE(FreeSpace(cloud, 0.5F).isFree(Vector3f::Zero()));
  for (int i = 0; i < 10; ++i)
    for (const float bad : {nan, inf, -inf, 1e30F}) {
      cloud.points.emplace_back(bad, 0.0F, 0.0F);
      cloud.origins.emplace_back(0.0F, 0.0F, 0.0F);
      cloud.points.emplace_back(5.0F, 0.0F, 0.0F);
      cloud.origins.emplace_back(0.0F, bad, 0.0F);
    }
  const FreeSpace space(cloud, 0.5F);
  for (const float x : {0.0F, 2.0F, 1000.0F, nan, inf}) EXPECT_FALSE(space.isFree({x, 0.0F, 0.0F})) << x;
}

}  // namespace
}  // namespace urban_nav_registration
