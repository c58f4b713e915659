// SPDX-License-Identifier: BSD-3-Clause
#include "surface_map.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_odometry {
namespace {

std::vector<Segment> sampleFloor(double x0, double size, int count, std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  std::vector<Segment> points;
  for (int i = 0; i < count; ++i) {
    const double x = x0 + dice.uniform(0.0, size), y = dice.uniform(0.0, size);
    points.push_back({{x, y, 0.1 + 0.005 * dice.normal()}, Matrix3d::Zero(), 1.0, 0.0, 0.0, i % 2});
  }
  return points;
}

TEST(SurfaceMap, FindsTheFinestPlaneAndOneOfACoarserLevelWhereItIsSparse) {
  SurfaceMap map(0.5, 3, 30.0);
  map.insert(sampleFloor(0.0, 4.0, 2000, 1), Vector3d(2, 2, 1), 0);
  map.insert(sampleFloor(8.0, 4.0, 100, 2), Vector3d(2, 2, 1), 0);
  const MapCell* dense = map.find(Vector3d(1.2, 1.2, 0.1), 0);
  ASSERT_NE(dense, nullptr);
  EXPECT_LT((dense->centre - Vector3d(1.25, 1.25, 0.25)).norm(), 1e-12);
  EXPECT_NEAR(dense->plane.mean.z(), 0.1, 0.01);
  const MapCell* sparse = map.find(Vector3d(9.2, 1.2, 0.1), 0);
  ASSERT_NE(sparse, nullptr);
  EXPECT_GT(sparse->moments.count, 6.0);
  EXPECT_NE((sparse->centre - Vector3d(9.25, 1.25, 0.25)).norm(), 0.0);
  EXPECT_EQ(map.find(Vector3d(30.0, 0.0, 0.0), 0), nullptr);
  const MapCell* coarse = map.find(Vector3d(1.2, 1.2, 0.1), 2);
  ASSERT_NE(coarse, nullptr);
  EXPECT_LT((coarse->centre - Vector3d(1, 1, 1)).norm(), 1e-12);
}

TEST(SurfaceMap, FarPointsEnterOnlyCoarseCubes) {
  SurfaceMap map(0.5, 3, 10.0);
  map.insert(sampleFloor(15.0, 2.0, 500, 3), Vector3d(0, 0, 0), 0);
  EXPECT_TRUE(map.cells(0).empty());
  EXPECT_FALSE(map.cells(1).empty());
}

TEST(SurfaceMap, TheConeOfARingIsNoPlane) {
  SurfaceMap map(0.5, 3, 100.0);
  std::vector<Segment> ring;  // a corner of two walls, cut by a level ring
  for (int i = 0; i < 100; ++i) {
    ring.push_back({{0.01 * i, 0.1, 1.0}, Matrix3d::Zero(), 1.0, 0.0, 0.0, 7});
    ring.push_back({{0.1, 0.01 * i, 1.0}, Matrix3d::Zero(), 1.0, 0.0, 0.0, 7});
  }
  map.insert(ring, Vector3d(5, 5, 1), 0);
  for (int level = 0; level < 3; ++level) EXPECT_EQ(map.find(Vector3d(0.1, 0.1, 1.0), level), nullptr) << level;
  for (Segment& segment : ring) segment = {segment.mean + Vector3d(0, 0, 0.2), Matrix3d::Zero(), 1.0, 0.0, 0.0, 8};
  map.insert(ring, Vector3d(5, 5, 1), 1);
  const MapCell* wall = map.find(Vector3d(0.75, 0.1, 1.1), 0);
  ASSERT_NE(wall, nullptr);
  EXPECT_GT(std::abs(wall->plane.normal.y()), 0.999);
}

TEST(SurfaceMap, PruningKeepsWhatIsNear) {
  SurfaceMap map(0.5, 2, 100.0);
  map.insert(sampleFloor(0.0, 4.0, 1000, 4), Vector3d(0, 0, 0), 0);
  map.insert(sampleFloor(80.0, 4.0, 1000, 5), Vector3d(80, 0, 0), 1);
  map.prune(Vector3d(82, 2, 0), 20.0);
  EXPECT_EQ(map.find(Vector3d(1.2, 1.2, 0.1), 0), nullptr);
  EXPECT_NE(map.find(Vector3d(81.2, 1.2, 0.1), 0), nullptr);
  for (int level = 0; level < 2; ++level)
    for (const MapCell& cell : map.cells(level)) EXPECT_LE((cell.centre - Vector3d(82, 2, 0)).norm(), 20.0);
}

TEST(SurfaceMap, AnHourInOnePlaceStaysBoundedAndFollowsTheNewestPoints) {
  SurfaceMap map(0.5, 1, 100.0);
  std::vector<Segment> points = sampleFloor(0.0, 0.5, 100, 6);
  for (int i = 0; i < 200; ++i) map.insert(points, Vector3d(0, 0, 0), i);
  for (Segment& point : points) point.mean.z() += 0.05;
  for (int i = 0; i < 200; ++i) map.insert(points, Vector3d(0, 0, 0), 200 + i);
  const MapCell* cell = map.find(Vector3d(0.2, 0.2, 0.1), 0);
  ASSERT_NE(cell, nullptr);
  EXPECT_LE(cell->moments.count, 2100.0);
  EXPECT_NEAR(cell->plane.mean.z(), 0.15, 0.005);
}

TEST(SurfaceMap, PointsBeyondAllCubesAreLeftOut) {
  SurfaceMap map(0.5, 2, 1e9);
  map.insert({{{1e9, 0, 0}, Matrix3d::Zero(), 1.0, 0.0, 0.0, 0}, {{0, -1e12, 0}, Matrix3d::Zero(), 1.0, 0.0, 0.0, 1}},
             Vector3d(0, 0, 0), 0);
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(map.find(Vector3d(1e9, 0, 0), 0), nullptr);
}

TEST(SurfaceMap, TheArchiveGivesTheSameMapAndRefusesCellsElsewhere) {
  SurfaceMap map(0.5, 2, 30.0);
  map.insert(sampleFloor(0.0, 4.0, 1000, 7), Vector3d(0, 0, 0), 3);
  urban_nav_core::Archive out;
  map.archive(out);
  const std::string bytes = out.take();
  SurfaceMap copy(0.5, 2, 30.0);
  urban_nav_core::Archive in(bytes, "map");
  copy.archive(in);
  in.finish();
  urban_nav_core::Archive again;
  copy.archive(again);
  EXPECT_EQ(again.take(), bytes);
  SurfaceMap other(0.4, 2, 30.0);  // cubes of other sizes: the keys do not fit
  urban_nav_core::Archive wrong(bytes, "map");
  EXPECT_THROW(other.archive(wrong), urban_nav_core::DataError);
}

}  // namespace
}  // namespace laser_odometry
