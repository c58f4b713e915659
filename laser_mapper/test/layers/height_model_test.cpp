// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/height_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace laser_mapper {
namespace {

using urban_nav_core::Vector3d;

/// A drive along x over ground that rises across it by 15 %, with a pavement, a wall, a low wall, an arch and a bird.
class HeightModelTest : public ::testing::Test {
 protected:
  static double groundAt(double y) { return 0.15 * y; }

  HeightModelTest() {
    for (double x = 0.0; x <= 10.0; x += 0.1) path_.emplace_back(x, 0.0, 0.0);
    for (double x = 0.0; x <= 10.0; x += 0.05)
      for (double y = -3.0; y <= 5.0; y += 0.05) add(x, y, groundAt(y) + (isPavement(y) ? 0.15 : 0.0));
    for (double x = 2.0; x <= 4.0; x += 0.05)
      for (double z = 0.0; z < 6.0; z += 0.05) add(x, 3.02, groundAt(3.02) + z);
    for (double x = 6.0; x <= 8.0; x += 0.05)
      for (double z = 0.0; z < 0.601; z += 0.05) add(x, 3.02, groundAt(3.02) + z);
    for (double x = 4.5; x <= 5.5; x += 0.05) add(x, 1.0, groundAt(1.0) + 2.5);
    add(9.02, 1.02, groundAt(1.02) + 0.9);
  }
  static bool isPavement(double y) { return y < -2.0; }
  void add(double x, double y, double z, const Eigen::Vector3f& normal = Eigen::Vector3f::Zero()) {
    MapPoint point;
    point.p = Vector3d(x, y, z).cast<float>();
    point.normal = normal;
    points_.push_back(point);
  }
  GroundGrid ground() const {
    GroundGrid ground({}, path_);
    ground.addSurface(points_);
    ground.find();
    return ground;
  }
  double at(const Raster& raster, double x, double y) const {
    const int u = static_cast<int>(std::floor((x - raster.x0) / raster.cell));
    const int v = static_cast<int>(std::floor((y - raster.y0) / raster.cell));
    return static_cast<double>(raster.values[raster.at(u, v)]);
  }

  std::vector<Vector3d> path_;
  std::vector<MapPoint> points_;
};

TEST_F(HeightModelTest, IsTheGroundAndObjectsOnIt) {
  const GroundGrid grid = ground();
  HeightModel model(grid);
  model.add(points_);
  const Raster raster = model.elevation();
  for (double y = -1.75; y < 2.9; y += 0.1)  // the middle of each cell; points are 0.05 m apart
    EXPECT_NEAR(at(raster, 9.52, y), groundAt(y), 0.15 * 0.05) << y;
  EXPECT_NEAR(at(raster, 9.52, -2.55), groundAt(-2.55) + 0.15, 0.15 * 0.05) << "pavement";
  EXPECT_NEAR(at(raster, 7.02, 3.02), groundAt(3.02) + 0.6, 1e-3) << "top of the low wall";
  EXPECT_NEAR(at(raster, 3.02, 3.02), groundAt(3.02) + 1.5, 0.051) << "the robot's height at the wall";
  EXPECT_NEAR(at(raster, 5.02, 1.02), groundAt(1.02), 0.01) << "below the arch";
  EXPECT_NEAR(at(raster, 9.02, 1.02), groundAt(1.02), 0.01) << "a single point above";
  EXPECT_EQ(at(raster, 5.0, 7.0), static_cast<double>(kNoValue));
}

TEST_F(HeightModelTest, DoesNotDependOnTheOrderOfPoints) {
  const GroundGrid grid = ground();
  HeightModel forwards(grid), backwards(grid);
  forwards.add(points_);
  std::reverse(points_.begin(), points_.end());
  backwards.add(points_);
  const Raster a = forwards.elevation(), b = backwards.elevation();
  for (std::size_t i = 0; i < a.values.size(); ++i) ASSERT_NEAR(a.values[i], b.values[i], 1e-6);
}

TEST_F(HeightModelTest, GroundIsWhereTheRobotCanDrive) {
  const GroundGrid grid = ground();
  std::size_t wrong = 0;
  for (const MapPoint& point : points_) {
    const double y = static_cast<double>(point.p.y()), above = static_cast<double>(point.p.z()) - groundAt(y);
    const bool is_ground = isPavement(y) ? above < 0.16 : above < 0.001;
    const bool is_wall = above > 0.12;
    if ((is_ground && !grid.isGround(point)) || (is_wall && !isPavement(y) && grid.isGround(point))) ++wrong;
  }
  EXPECT_EQ(wrong, 0U);
  MapPoint upright;
  upright.p = Vector3d(5.0, 2.0, groundAt(2.0)).cast<float>();
  EXPECT_TRUE(grid.isGround(upright));
  upright.normal = {0.0F, -1.0F, 0.0F};
  EXPECT_FALSE(grid.isGround(upright)) << "foot of a wall";
  upright.p.x() = 500.0F;
  EXPECT_FALSE(grid.isGround(upright)) << "outside";
}

}  // namespace
}  // namespace laser_mapper
