// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>

namespace laser_mapper {
namespace {

/// Points of a wall, a floor and a few in the air within the tile (-1, 0).
std::vector<TilePoint> drawnSurfaces(std::size_t count) {
  std::mt19937 random(11);
  const int width = kTileCells * kVoxelSteps;
  const auto within = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  std::vector<TilePoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    TilePoint& point = points[i];
    point.x = -width + within(width);
    point.y = i % 3 == 0 ? 9000 : within(width);
    point.z = i % 3 == 1 ? -3000 : within(width / 4) - 5000;
    point.pose = static_cast<std::uint32_t>(i);
  }
  return points;
}

using Voxel = std::tuple<int, int, int>;

Voxel voxelAt(const TilePoint& p, int level) {
  const int edge = kVoxelSteps << level;
  const auto divide = [&](int v) { return v >= 0 ? v / edge : -((-v + edge - 1) / edge); };
  return {divide(p.x), divide(p.y), divide(p.z)};
}

std::vector<TilePoint> all(const Levels& levels, int from) {
  std::vector<TilePoint> points;
  for (int level = from; level <= kCoarsestLevel; ++level)
    points.insert(points.end(), levels[static_cast<std::size_t>(level)].begin(),
                  levels[static_cast<std::size_t>(level)].end());
  return points;
}

TEST(LevelsOfDetail, EachPointIsInExactlyOneLevel) {
  std::vector<TilePoint> points = drawnSurfaces(20000);
  points.push_back(points.front());  // two points may coincide
  std::vector<TilePoint> levels = all(divideIntoLevels(points), 0);
  std::sort(points.begin(), points.end());
  std::sort(levels.begin(), levels.end());
  EXPECT_TRUE(levels == points);
}

TEST(LevelsOfDetail, CoarseLevelsHaveOnePointInEachOccupiedVoxel) {
  const std::vector<TilePoint> points = drawnSurfaces(20000);
  const Levels levels = divideIntoLevels(points);
  for (int level = 1; level <= kCoarsestLevel; ++level) {
    std::set<Voxel> occupied;
    for (const TilePoint& point : points) occupied.insert(voxelAt(point, level));
    std::map<Voxel, int> shown;
    for (const TilePoint& point : all(levels, level)) ++shown[voxelAt(point, level)];
    EXPECT_EQ(shown.size(), occupied.size()) << level;
    for (const auto& [voxel, count] : shown) EXPECT_EQ(count, 1) << level;
  }
}

TEST(LevelsOfDetail, APointBelongsToTheCoarsestLevelWhoseVoxelItOpens) {
  // A point of level k is alone in its voxel of level k among the levels from k up, and not in that of level k + 1.
  const Levels levels = divideIntoLevels(drawnSurfaces(20000));
  for (int level = 0; level < kCoarsestLevel; ++level) {
    std::set<Voxel> coarser;
    for (const TilePoint& point : all(levels, level + 1)) coarser.insert(voxelAt(point, level + 1));
    for (const TilePoint& point : levels[static_cast<std::size_t>(level)])
      EXPECT_EQ(coarser.count(voxelAt(point, level + 1)), 1U) << level;
  }
}

TEST(LevelsOfDetail, DoNotDependOnTheOrderOfThePoints) {
  std::vector<TilePoint> points = drawnSurfaces(5000);
  const Levels before = divideIntoLevels(points);
  std::shuffle(points.begin(), points.end(), std::mt19937(5));
  EXPECT_TRUE(divideIntoLevels(points) == before);
}

TEST(LevelsOfDetail, CoarseLevelsAreSpreadOverASurface) {
  // A pattern, such as the lowest corner of each voxel, would show as lines: the mean place within a voxel is its
  // middle.
  const Levels levels = divideIntoLevels(drawnSurfaces(40000));
  for (const int level : {1, 2, 3}) {
    const int edge = kVoxelSteps << level;
    double sum = 0.0, count = 0.0;
    for (const TilePoint& point : all(levels, level)) {
      sum += static_cast<double>(((point.x % edge) + edge) % edge) / edge;
      ++count;
    }
    EXPECT_NEAR(sum / count, 0.5, 5.0 * 0.29 / std::sqrt(count)) << level;  // 0.29: sigma of a uniform number
  }
}

TEST(LevelsOfDetail, NoPointsHaveNoLevels) {
  for (const std::vector<TilePoint>& level : divideIntoLevels({})) EXPECT_TRUE(level.empty());
}

}  // namespace
}  // namespace laser_mapper
