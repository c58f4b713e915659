// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dense_stereo/dense_stereo.hpp"
#include "dense_stereo/ground_plane.hpp"
#include "dense_stereo/obstacles.hpp"
#include "support/rendered_pair.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/testing/textured_street.hpp"

namespace dense_stereo {
namespace {

using testing_support::RenderedPair;
using urban_nav_core::StereoCamera;
using urban_nav_core::testing::Scene;

constexpr double kRad = M_PI / 180.0;

StereoCamera groundCamera() {
  StereoCamera camera;
  camera.left = {300.0, 300.0, 191.5, 143.5, 384, 288};
  camera.baseline = 0.12;
  return camera;
}

/// Points of a height field z(x, forward) below a level camera, with Gaussian disparity noise of `sigma` px.
template <typename Height>
std::vector<DensePoint> pointsOn(const Height& heightAt, double sigma, unsigned seed) {
  const StereoCamera camera = groundCamera();
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sigma);
  DisparityImage image;
  image.width = 384;
  image.height = 288;
  image.disparity.assign(384 * 288, DisparityImage::kInvalid);
  image.variance.assign(384 * 288, static_cast<float>(sigma * sigma));
  for (int v = 0; v < 288; ++v)
    for (int u = 0; u < 384; ++u)
      for (double z = 0.5; z < 6.0; z += 0.01) {  // the first ground along the ray
        const auto isBelow = [&](double depth) {
          return (v - camera.left.cy) / 300.0 * depth >= 1.0 - heightAt((u - camera.left.cx) / 300.0 * depth, depth);
        };
        if (!isBelow(z)) continue;
        double near = z - 0.01, far = z;
        for (int i = 0; i < 20; ++i) (isBelow(0.5 * (near + far)) ? far : near) = 0.5 * (near + far);
        image.disparity[image.index(u, v)] = static_cast<float>(std::max(0.0, 300.0 * 0.12 / far + noise(random)));
        break;
      }
  return makePoints(image, camera, 5.0, 2);
}

TEST(GroundPlane, IsExactWithinItsCovarianceOnAFlatGround) {
  double squared = 0.0;
  const int runs = 8;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const GroundPlane plane = findGround(pointsOn([](double, double) { return 0.0; }, 0.2, seed), groundCamera());
    ASSERT_TRUE(plane.isFound()) << plane.sentence;
    EXPECT_LT(std::acos(std::min(1.0, plane.up.dot(-Eigen::Vector3d::UnitY()))), 0.2 * kRad);
    EXPECT_NEAR(plane.height, 1.0, 0.01);
    EXPECT_GT(plane.support, 0.9);
    const double error = plane.height - 1.0;
    squared += error * error / plane.covariance(3, 3);
  }
  EXPECT_LT(squared / runs, 4.0) << "no more than two standard deviations, root mean square";
}

TEST(GroundPlane, ReportsStepsAndABreakInTheSlope) {
  const auto steps = [](double, double z) { return z < 2.2 ? 0.0 : 0.15 * std::ceil((z - 2.2) / 0.3); };
  const GroundPlane stairs = findGround(pointsOn(steps, 0.1, 1), groundCamera());
  EXPECT_FALSE(stairs.isFound()) << stairs.support;
  EXPECT_FALSE(stairs.sentence.empty());
  const auto ramp = [](double, double z) { return z < 3.3 ? 0.0 : 0.35 * (z - 3.3); };
  const GroundPlane slope = findGround(pointsOn(ramp, 0.1, 1), groundCamera());
  EXPECT_EQ(slope.verdict, GroundVerdict::NotPlanar) << slope.support;
}

/// A wall across the view at 3.2 m has more pixels near the ground than the ground, but no ground area.
TEST(GroundPlane, IsFoundBeforeAWall) {
  const GroundPlane plane =
      findGround(pointsOn([](double, double z) { return z < 3.2 ? 0.0 : 50.0; }, 0.1, 1), groundCamera());
  ASSERT_TRUE(plane.isFound()) << plane.sentence;
  EXPECT_LT(std::acos(std::min(1.0, plane.up.dot(-Eigen::Vector3d::UnitY()))), 0.3 * kRad);
  EXPECT_NEAR(plane.height, 1.0, 0.01);
}

TEST(GroundPlane, NeedsPointsAndADirectionNearGravity) {
  EXPECT_EQ(findGround({}, groundCamera()).verdict, GroundVerdict::TooFewPoints);
  GroundOptions sideways;
  sideways.up = Eigen::Vector3d::UnitX();
  const auto flat = pointsOn([](double, double) { return 0.0; }, 0.1, 1);
  EXPECT_EQ(findGround(flat, groundCamera(), sideways).verdict, GroundVerdict::NoPlane);
}

TEST(GroundPlane, IsFoundInRenderedRooms) {
  const Scene room = urban_nav_core::testing::texturedRoom();
  for (const double pitch : {0.0, 10.0, 20.0}) {
    const RenderedPair view(room, -2.0, 0.5, 0.9, pitch * kRad, 3.0 * kRad);
    DenseStereo stereo{Parameters()};
    const StereoResult& result = stereo.process(view.pair());
    const GroundPlane plane = findGround(makePoints(result.image, view.camera(), 5.0, 2), view.camera());
    ASSERT_TRUE(plane.isFound()) << plane.sentence << " at " << pitch;
    EXPECT_GT(plane.support, 0.8) << pitch;
    EXPECT_LT(std::acos(std::min(1.0, plane.up.dot(view.up()))), 0.3 * kRad) << pitch;
    EXPECT_NEAR(plane.height, view.height(), 0.01) << pitch;
  }
}

TEST(Obstacles, AreTheObjectsOnTheGroundOnly) {
  const auto box = [](double x, double z) { return std::abs(x) < 0.3 && z > 2.5 && z < 3.0 ? 0.15 : 0.0; };
  const auto points = pointsOn(box, 0.1, 1);
  const GroundPlane plane = findGround(points, groundCamera());
  ASSERT_TRUE(plane.isFound()) << plane.sentence;
  const auto obstacles = findObstacles(points, 2, plane);
  EXPECT_GT(obstacles.size(), 50U);
  for (const ObstaclePoint& obstacle : obstacles) {
    EXPECT_LT(std::abs(obstacle.p_cam.x()), 0.4F);
    EXPECT_NEAR(obstacle.p_cam.z(), 2.75F, 0.5F);
    EXPECT_NEAR(obstacle.height, 0.12F, 0.08F);
  }
  const auto empty = pointsOn([](double, double) { return 0.0; }, 0.2, 2);
  EXPECT_TRUE(findObstacles(empty, 2, findGround(empty, groundCamera())).empty());
}

TEST(Obstacles, IncludeHoles) {
  const auto hole = [](double x, double z) { return std::abs(x) < 0.4 && z > 2.0 && z < 3.0 ? -0.2 : 0.0; };
  const auto points = pointsOn(hole, 0.1, 1);
  const auto obstacles = findObstacles(points, 2, findGround(points, groundCamera()));
  ASSERT_FALSE(obstacles.empty());
  for (const ObstaclePoint& obstacle : obstacles) EXPECT_LT(obstacle.height, 0.0F);
}

TEST(DensePoints, CarryTheCovarianceOfTheirDisparity) {
  const StereoCamera camera = groundCamera();
  DensePoint point;
  point.u = 250;
  point.v = 200;
  point.disparity = 12.0F;
  point.variance = 0.04F;
  point.p_cam = Eigen::Vector3f(0.585F, 0.565F, 3.0F);
  const Eigen::Matrix3d covariance = pointCovariance(point, camera);
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), 3.0 * 0.2 / 12.0, 1e-6);
  EXPECT_GT(covariance.determinant(), 0.0);
}

}  // namespace
}  // namespace dense_stereo
