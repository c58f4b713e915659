// SPDX-License-Identifier: BSD-3-Clause
#include "lidar/lidar_pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

constexpr double kDegree = M_PI / 180.0;

double elevationAngle(const Eigen::Vector3d& direction) { return std::asin(direction.z()); }

TEST(LidarPattern, TimesIncreaseByColumnThenByRing) {
  for (const LidarModel& model : {LidarModel{LidarModel::Pattern::Rings, 16},
                                  LidarModel{LidarModel::Pattern::Rings, 37}, parseLidarModel("livox", "--lidar")}) {
    const LidarPattern pattern(model);
    double last = -1.0;
    for (int column = 0; column < pattern.columns(); ++column) {
      for (int ring = 0; ring < pattern.rings(); ++ring) {
        const double t = pattern.time(column, ring);
        ASSERT_GT(t, last);
        last = t;
        ASSERT_NEAR(pattern.direction(3, column, ring).norm(), 1.0, 1e-12);
      }
    }
    EXPECT_GE(pattern.time(0, 0), 0.0);
    EXPECT_LT(last, LidarPattern::kPeriod);
  }
}

TEST(LidarPattern, RingsRiseFromTheLowestAndTurnClockwiseFromTheBack) {
  for (const int rings : {16, 64, 128}) {
    const LidarPattern pattern({LidarModel::Pattern::Rings, rings});
    EXPECT_NEAR(pattern.elevation(0), (rings == 16 ? -15.0 : -25.0) * kDegree, 1e-12);
    EXPECT_NEAR(pattern.elevation(rings - 1), 15.0 * kDegree, 1e-12);
    for (int ring = 0; ring < rings; ++ring)
      EXPECT_NEAR(elevationAngle(pattern.direction(0, 700, ring)), pattern.elevation(ring), 1e-12);
    const Eigen::Vector3d back = pattern.direction(0, 0, 0), left = pattern.direction(0, pattern.columns() / 4, 0);
    EXPECT_LT(back.x(), -0.9);
    EXPECT_GT(left.y(), 0.9);
    EXPECT_EQ(pattern.direction(0, 5, 3), pattern.direction(9, 5, 3));
    EXPECT_NEAR(elevationAngle(pattern.direction(0, 5, 3, 0.01)), pattern.elevation(3) + 0.01, 1e-12);
  }
}

TEST(LidarPattern, RosetteStaysInItsConeAndDoesNotRepeat) {
  const LidarPattern pattern(parseLidarModel("livox", "--lidar"));
  EXPECT_EQ(pattern.rings(), 6);
  double widest = 0.0, narrowest = 1.0;
  for (int column = 0; column < pattern.columns(); ++column) {
    const Eigen::Vector3d direction = pattern.direction(0, column, 2);
    const double angle = std::acos(direction.x());
    EXPECT_LT(angle, 36.5 * kDegree);
    widest = std::max(widest, angle);
    narrowest = std::min(narrowest, angle);
  }
  EXPECT_GT(widest, 34.0 * kDegree);
  EXPECT_LT(narrowest, 1.0 * kDegree);
  EXPECT_GT((pattern.direction(0, 100, 0) - pattern.direction(1, 100, 0)).norm(), 0.01);
}

TEST(LidarModel, IsReadFromTheOption) {
  EXPECT_EQ(parseLidarModel("16", "--lidar").rings, 16);
  EXPECT_EQ(parseLidarModel("128", "--lidar").rings, 128);
  EXPECT_EQ(parseLidarModel("livox", "--lidar").pattern, LidarModel::Pattern::Rosette);
  const LidarPattern planar(parseLidarModel("planar", "--lidar"));
  EXPECT_EQ(planar.rings(), 1);
  for (const int column : {0, 500, 1999}) EXPECT_EQ(planar.direction(0, column, 0).z(), 0.0);
  for (const char* word : {"", "15", "129", "64.5", "ouster", "nan", "-64"}) {
    try {
      parseLidarModel(word, "--lidar");
      ADD_FAILURE() << word << " was accepted";
    } catch (const urban_nav_core::UserError& error) {
      EXPECT_NE(std::string(error.what()).find("16...128 rings, or livox"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace urban_nav_sim
