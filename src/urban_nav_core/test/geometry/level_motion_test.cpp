// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/level_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_core {
namespace {

const std::vector<Vector3d> kCorners = {{0.0, 0.0, 0.0}, {10.0, 1.0, 2.0}, {9.0, 7.0, -1.0}, {-3.0, 8.0, 0.5}};

TEST(FitLevelMotion, FindsATurnAndAShift) {
  for (const double yaw : {-3.0, -0.4, 0.0, 1.2, 3.1}) {
    const LevelMotion moved{yaw, {40.0, -7.0, 3.0}};
    std::vector<Vector3d> to;
    for (const Vector3d& p : kCorners) to.push_back(moved * p);
    const LevelMotion found = fitLevelMotion(kCorners, to, {1.0, 2.0, 0.5, 1.0});
    EXPECT_NEAR(std::remainder(found.yaw - yaw, 2.0 * M_PI), 0.0, 1e-12);
    EXPECT_LT((found.shift - moved.shift).norm(), 1e-12);
  }
}

TEST(FitLevelMotion, PointsWithoutWeightDoNotCount) {
  std::vector<Vector3d> to = kCorners;
  to[3] += Vector3d(100.0, -50.0, 7.0);
  const LevelMotion found = fitLevelMotion(kCorners, to, {1.0, 1.0, 1.0, 0.0});
  EXPECT_NEAR(found.yaw, 0.0, 1e-12);
  EXPECT_LT(found.shift.norm(), 1e-12);
}

TEST(FitLevelMotion, TurnsNothingWithoutExtent) {
  const LevelMotion found =
      fitLevelMotion({{1.0, 2.0, 3.0}, {1.0, 2.0, 5.0}}, {{4.0, 2.0, 3.0}, {4.0, 2.0, 5.0}}, {1.0, 1.0});
  EXPECT_EQ(found.yaw, 0.0);
  EXPECT_LT((found.shift - Vector3d(3.0, 0.0, 0.0)).norm(), 1e-12);
}

}  // namespace
}  // namespace urban_nav_core
