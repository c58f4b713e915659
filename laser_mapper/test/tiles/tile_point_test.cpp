// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/tile_point.hpp"

#include <gtest/gtest.h>

#include <random>

namespace laser_mapper {
namespace {

constexpr double kPointVoxel = 0.05;

std::vector<TilePoint> drawnPoints(const LevelTile& tile, std::size_t count) {
  std::mt19937 random(7);
  const int width = kTileCells * kVoxelSteps * (1 << tile.level);
  const auto within = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  std::vector<TilePoint> points(count);
  for (TilePoint& point : points) {
    point.x = tile.tile.x * width + within(width);
    point.y = tile.tile.y * width + within(width);
    point.z = within(1 << 24) - (1 << 23);
    point.session = static_cast<std::uint16_t>(within(1 << 16));
    point.pose = static_cast<std::uint32_t>(within(1 << 24));
    for (const auto member : {&TilePoint::red, &TilePoint::green, &TilePoint::blue, &TilePoint::reflectance,
                              &TilePoint::sensor, &TilePoint::sigma})
      point.*member = static_cast<std::uint8_t>(within(256));
  }
  return points;
}

TEST(TilePoints, APositionIsKeptToHalfAStepAlongEachAxis) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> drawn(-400.0F, 400.0F);
  for (int i = 0; i < 1000; ++i) {
    MapPoint point;
    point.p = {drawn(random), drawn(random), drawn(random)};
    const Eigen::Vector3d apart = tilePlace(toTilePoint(point, kPointVoxel), kPointVoxel) - point.p.cast<double>();
    EXPECT_LE(apart.cwiseAbs().maxCoeff(), 0.5 * kPointVoxel / kVoxelSteps + 1e-9) << point.p.transpose();
  }
}

TEST(TilePoints, ColoursReflectanceSensorAndSigmaAreKept) {
  MapPoint point;
  point.red = 1;
  point.green = 2;
  point.blue = 3;
  point.intensity = 4;
  point.laser = 255;
  point.sigma = 0.0123F;
  const TilePoint stored = toTilePoint(point, kPointVoxel);
  EXPECT_EQ(stored.red, 1);
  EXPECT_EQ(stored.green, 2);
  EXPECT_EQ(stored.blue, 3);
  EXPECT_EQ(stored.reflectance, 4);
  EXPECT_EQ(stored.sensor, 255);
  EXPECT_EQ(stored.sigma, 25) << "of 0.5 mm";
  point.sigma = 3.0F;
  EXPECT_EQ(toTilePoint(point, kPointVoxel).sigma, 255);
}

TEST(TilePoints, PointsComeBackFromTheirBytes) {
  for (const LevelTile& tile : {LevelTile{0, {0, 0}}, LevelTile{0, {-3, 7}}, LevelTile{kCoarsestLevel, {-1, 2}}}) {
    const std::vector<TilePoint> points = drawnPoints(tile, 500);
    const std::string bytes = printTile(tile, points);
    EXPECT_EQ(bytes.size(), 500 * kTilePointBytes);
    const auto back = readTile(tile, bytes);
    ASSERT_TRUE(back) << toString(tile);
    EXPECT_TRUE(*back == points) << toString(tile);
  }
  EXPECT_TRUE(readTile({0, {0, 0}}, "")->empty());
}

TEST(TilePoints, BytesOfAnotherLengthOrTileAreRefused) {
  const LevelTile coarse{3, {0, 0}};
  const std::string bytes = printTile(coarse, drawnPoints(coarse, 100));
  EXPECT_FALSE(readTile(coarse, bytes.substr(1)));
  EXPECT_FALSE(readTile({0, {0, 0}}, bytes)) << "the points lie beyond a tile of the finest level";
}

TEST(TilePoints, NamesOfTilesComeBackAndOthersAreRefused) {
  for (const LevelTile& tile : {LevelTile{0, {0, 0}}, LevelTile{kCoarsestLevel, {-12, 345}}})
    EXPECT_TRUE(parseLevelTile(toString(tile)) == tile) << toString(tile);
  for (const char* text : {"", "0", "0/", "0/1", "0/1,", "8/0,0", "-1/0,0", "x/0,0", "0/1,2,3", "0,1/2"})
    EXPECT_FALSE(parseLevelTile(text)) << text;
}

TEST(TilePoints, ATileIsCoveredByOneOfEachLevel) {
  EXPECT_TRUE((coveringTile({5, -1}, 0) == LevelTile{0, {5, -1}}));
  EXPECT_TRUE((coveringTile({5, -1}, 2) == LevelTile{2, {1, -1}}));
  EXPECT_TRUE((coveringTile({-5, 4}, 2) == LevelTile{2, {-2, 1}}));
}

}  // namespace
}  // namespace laser_mapper
