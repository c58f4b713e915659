// SPDX-License-Identifier: BSD-3-Clause
#include "motion/ground_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/simulate_drive.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2d;

RoughGround plane(double a, double b) {
  return {[a, b](double x, double y) { return a * x + b * y; }, 0.0, Noise(1, "ground")};
}

TEST(GroundContact, OnTheLevelTheAxleIsARadiusUp) {
  const AxleOnGround axle = layOnGround(RoughGround({}, 0.0, Noise(1, "ground")), Vector2d(3, 4), 0.7, 0.05);
  EXPECT_NEAR(axle.height, kWheelRadius, 1e-12);
  EXPECT_NEAR(axle.roll, 0.0, 1e-12);
}

// Both wheel centres are a radius from the plane, along its normal, whatever the direction and the lean.
TEST(GroundContact, OnPlanesBothWheelsTouch) {
  const double a = 0.12, b = -0.07;
  const Eigen::Vector3d normal = Eigen::Vector3d(-a, -b, 1.0).normalized();
  for (const double yaw : {0.0, 0.9, 2.0, -2.5}) {
    for (const double pitch : {0.0, 0.08, -0.05}) {
      const Vector2d middle(1.5, -2.0);
      const AxleOnGround axle = layOnGround(plane(a, b), middle, yaw, pitch);
      const Eigen::Quaterniond R = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(axle.roll, Eigen::Vector3d::UnitX());
      for (const double side : {-0.5, 0.5}) {
        const Eigen::Vector3d centre =
            Eigen::Vector3d(middle.x(), middle.y(), axle.height) + R * Eigen::Vector3d(0.0, side * kTrack, 0.0);
        EXPECT_NEAR(centre.dot(normal), kWheelRadius, 1e-5);
      }
    }
  }
}

TEST(GroundContact, SlopeIsUphillPositive) {
  EXPECT_NEAR(plane(0.1, 0.0).slope(0, 0, 0.0), std::atan(0.1), 1e-9);
  EXPECT_NEAR(plane(0.1, 0.0).slope(0, 0, M_PI), -std::atan(0.1), 1e-9);
  EXPECT_NEAR(plane(0.1, 0.0).slope(0, 0, M_PI / 2), 0.0, 1e-9);
}

TEST(GroundContact, RoughnessHasItsHeight) {
  const RoughGround rough({}, 1.0, Noise(1, "ground")), smooth({}, 0.0, Noise(1, "ground"));
  double square = 0.0;
  constexpr int kSide = 100;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      square += std::pow(rough.height(0.37 * i, 0.37 * j) - smooth.height(0.37 * i, 0.37 * j), 2) / (kSide * kSide);
    }
  }
  EXPECT_NEAR(std::sqrt(square), std::hypot(1.2e-3, 6e-3), 6e-4);
}

}  // namespace
}  // namespace urban_nav_sim
