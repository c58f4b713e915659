// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laser_mapper {
namespace {

using urban_nav_core::Vector3d;

constexpr double kWallAtY = 3.0, kRampFromX = 6.0, kRampSlope = 0.2;  // m, m, m of height per m

MapPoint surfacePoint(double x, double y, double z, const Eigen::Vector3f& normal) {
  MapPoint point;
  point.p = Vector3d(x, y, z).cast<float>();
  point.normal = normal;
  return point;
}

/// Level ground, a ramp along x, and a wall along the path.
std::vector<MapPoint> groundAndWall() {
  std::vector<MapPoint> points;
  for (double x = -2.0; x < 10.0; x += 0.05)
    for (double y = -2.0; y < kWallAtY; y += 0.05)
      points.push_back(surfacePoint(x, y, kRampSlope * std::max(0.0, x - kRampFromX), Eigen::Vector3f::UnitZ()));
  for (double x = -2.0; x < 5.0; x += 0.05)
    for (double z = 0.0; z < 2.0; z += 0.05) points.push_back(surfacePoint(x, kWallAtY, z, -Eigen::Vector3f::UnitY()));
  return points;
}

std::vector<Vector3d> pathOnGround() {
  std::vector<Vector3d> path;
  for (double x = 0.0; x < 8.0; x += 0.1) path.emplace_back(x, 0.0, kRampSlope * std::max(0.0, x - kRampFromX));
  return path;
}

std::size_t cellAt(const LiveLayers& layers, double x, double y) {
  const Raster& cells = layers.elevation;
  return cells.at(static_cast<int>((x - cells.x0) / cells.cell), static_cast<int>((y - cells.y0) / cells.cell));
}

TEST(LiveLayers, AreOfTheSameCellsAndAgreeWithTheWorld) {
  const std::vector<MapPoint> points = groundAndWall();
  const LiveLayers layers = makeLiveLayers([&](const auto& take) { take(points); }, pathOnGround(),
                                           [](const MapPoint&) { return std::optional(Vector3d(0.0, 0.0, 1.0)); });
  const auto cells = static_cast<std::size_t>(layers.elevation.width * layers.elevation.height);
  ASSERT_EQ(layers.occupancy.size(), cells);
  ASSERT_EQ(layers.traverse_cost.size(), cells);
  EXPECT_EQ(layers.occupancy[cellAt(layers, 2.05, 1.05)], 0) << "ground";
  EXPECT_EQ(layers.occupancy[cellAt(layers, 2.05, kWallAtY + 0.01)], 100) << "wall";
  EXPECT_EQ(layers.occupancy[cellAt(layers, 2.05, kWallAtY + 2.0)], -1) << "farther away than the wall";
  EXPECT_EQ(layers.traverse_cost[cellAt(layers, 2.05, kWallAtY + 2.0)], -1);
  EXPECT_LE(layers.traverse_cost[cellAt(layers, 2.05, 0.05)], 2) << "flat";
  EXPECT_EQ(layers.traverse_cost[cellAt(layers, 2.05, kWallAtY - 0.15)], 100) << "the foot of the wall";
  const std::size_t ramp = cellAt(layers, 8.05, 0.05);
  EXPECT_NEAR(layers.terrain.slope.values[ramp], std::atan(kRampSlope) * 180.0 / M_PI, 1.0);
  EXPECT_NEAR(layers.elevation.values[ramp], 2.05 * kRampSlope, 0.03);
  EXPECT_EQ(layers.occupancy[ramp], 0) << "a ramp is no obstacle";
}

}  // namespace
}  // namespace laser_mapper
