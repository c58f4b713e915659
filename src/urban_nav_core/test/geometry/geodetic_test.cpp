// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/geodetic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {
namespace {

constexpr double kRad = M_PI / 180.0;

TEST(LocalTangent, TakesPositionsThereAndBack) {
  for (const double latitude : {-80.0, -33.0, 0.0, 51.75, 84.0})
    for (const double longitude : {-179.9, -1.25, 0.0, 151.0}) {
      const LocalTangent tangent({latitude * kRad, longitude * kRad, 80.0});
      for (const Vector3d& p : {Vector3d(0.0, 0.0, 0.0), Vector3d(2500.0, -1200.0, 30.0), Vector3d(-9.0, 4.0, 900.0)})
        EXPECT_LT((tangent.toLocal(tangent.toGeodetic(p)) - p).norm(), 1e-4) << latitude << " " << longitude;
    }
}

TEST(LocalTangent, AMinuteOfLatitudeIsANauticalMileToTheNorth) {
  const LocalTangent tangent({45.0 * kRad, 7.0 * kRad, 0.0});
  const Vector3d north = tangent.toLocal({(45.0 + 1.0 / 60.0) * kRad, 7.0 * kRad, 0.0});
  EXPECT_NEAR(north.y(), 1852.2, 0.3);  // radius of curvature in the meridian at 45 deg: 6367.4 km
  EXPECT_NEAR(north.x(), 0.0, 1e-6);
  EXPECT_NEAR(tangent.toLocal({45.0 * kRad, 7.0 * kRad, 3.5}).z(), 3.5, 1e-6);
}

}  // namespace
}  // namespace urban_nav_core
