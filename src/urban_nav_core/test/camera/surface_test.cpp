// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/surface.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

StereoCamera surfaceCamera() { return {{400.0, 410.0, 250.0, 190.0, 512, 384}, 0.2, 0.3}; }

TEST(Surface, HasTheSlopesOfItsDisparity) {
  const StereoCamera c = surfaceCamera();
  const StereoCamera::Pixel pixel(300.0, 250.0, 289.7);
  const Eigen::Vector2d slopes(0.1, 0.3);
  const Eigen::Vector3d plane = surfaceThrough(c, pixel, slopes);
  for (const Eigen::Vector2d& d :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(5, 0), Eigen::Vector2d(0, 5), Eigen::Vector2d(-3, 4)}) {
    const double disparity = 10.3 + slopes.dot(d);
    const auto p = c.triangulate({300.0 + d.x(), 250.0 + d.y(), 300.0 + d.x() - disparity});
    ASSERT_TRUE(p);
    EXPECT_NEAR(plane.dot(*p), 1.0, 1e-9);
  }
}

TEST(Surface, WarpsAsItsPointsProject) {
  const StereoCamera c = surfaceCamera();
  const Eigen::Vector2d pixel(310.0, 150.0);
  const Eigen::Vector3d ray = c.left.ray(pixel), plane = surfaceThrough(c, {310.0, 150.0, 300.0}, {0.05, 0.2});
  const Pose T_to_from(expSo3({0.05, -0.1, 0.02}), {0.3, -0.1, -0.8});
  const auto project = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector3d r = c.left.ray(p);
    return *c.left.project(T_to_from * Eigen::Vector3d(r / plane.dot(r)));
  };
  const auto warp = warpOfSurface(c, plane, ray, T_to_from);
  ASSERT_TRUE(warp);
  for (const Eigen::Vector2d& d : {Eigen::Vector2d(6, 0), Eigen::Vector2d(0, -7), Eigen::Vector2d(-5, 4)})
    EXPECT_LT((project(pixel + d) - project(pixel) - warp->A * d / (1.0 + warp->bend.dot(d))).norm(), 1e-9);
  EXPECT_FALSE(warpOfSurface(c, plane, ray, Pose(Quaterniond::Identity(), {0.0, 0.0, -100.0}))) << "not in front";
}

TEST(Surface, KeepsItsSlantForASmallCorrectionAlone) {
  const Eigen::Vector3d plane(0.02, 0.1, 0.2), ray(0.1, 0.2, 1.0);
  EXPECT_NEAR(surfaceAt(plane, ray, 0.3).dot(ray), 0.3, 1e-12);
  EXPECT_NEAR(surfaceAt(plane, ray, 0.3).x() / surfaceAt(plane, ray, 0.3).y(), 0.2, 1e-12);
  EXPECT_EQ(surfaceAt(plane, ray, 5.0), Eigen::Vector3d(0.0, 0.0, 5.0));
  EXPECT_EQ(surfaceAt(plane, ray, -1.0), Eigen::Vector3d::Zero().eval());
}

}  // namespace
}  // namespace urban_nav_core
