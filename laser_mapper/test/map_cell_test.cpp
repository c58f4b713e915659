// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/map_cell.hpp"

#include <gtest/gtest.h>

namespace laser_mapper {
namespace {

std::vector<MapCell> someCells(const Tile& tile) {
  std::vector<MapCell> cells(3);
  for (int i = 0; i < 3; ++i) {
    MapCell& cell = cells[static_cast<std::size_t>(i)];
    cell.cell = {tile.x * kTileCells + 100 * i, tile.y * kTileCells + 255 - i, 50 - 60 * i};
    cell.count = static_cast<std::uint16_t>(1 + 30000 * i);
    cell.laser = static_cast<std::uint8_t>(i);
    cell.intensity = static_cast<std::uint8_t>(100 * i);
    cell.offset = Eigen::Vector3f(0.25F, 0.5F, 0.999F);
    cell.to_laser = Eigen::Vector3f(-0.6F, 0.8F, 0.0F);
    cell.range = 1.5F + 10.0F * static_cast<float>(i);
    cell.time_us = 3'999'999 - i;
  }
  return cells;
}

TEST(MapCell, UnpacksWhatWasPackedToItsResolution) {
  for (const Tile& tile : {Tile{0, 0}, Tile{-3, 7}}) {
    const std::vector<MapCell> cells = someCells(tile);
    const auto back = unpackCells(tile, packCells(tile, cells));
    ASSERT_TRUE(back);
    ASSERT_EQ(back->size(), cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const MapCell &a = cells[i], &b = (*back)[i];
      EXPECT_EQ(a.cell.x, b.cell.x);
      EXPECT_EQ(a.cell.y, b.cell.y);
      EXPECT_EQ(a.cell.z, b.cell.z);
      EXPECT_EQ(a.count, b.count);
      EXPECT_EQ(a.laser, b.laser);
      EXPECT_EQ(a.intensity, b.intensity);
      EXPECT_EQ(a.time_us, b.time_us);
      EXPECT_NEAR(a.range, b.range, 6e-4F);
      EXPECT_LT((a.offset - b.offset).norm(), 2e-5F);
      EXPECT_LT((a.to_laser - b.to_laser).norm(), 0.008F);
    }
    EXPECT_EQ(packCells(tile, *back), packCells(tile, cells)) << "rounding is idempotent";
  }
}

TEST(MapCell, DamagedBytesAreRefused) {
  const Tile tile{1, 2};
  const std::string packed = packCells(tile, someCells(tile));
  for (std::size_t length = 0; length < packed.size(); ++length)
    EXPECT_FALSE(unpackCells(tile, std::string_view(packed).substr(0, length))) << length;
  EXPECT_FALSE(unpackCells(tile, "no cells at all, but some text"));
}

TEST(Tile, TextReadsBack) {
  for (const Tile& tile : {Tile{0, 0}, Tile{-12, 345}}) EXPECT_EQ(*parseTile(toString(tile)), tile);
  for (const char* text : {"", "1", "1,", ",2", "1;2", "a,b", "1,2,3", "99999999999,1"})
    EXPECT_FALSE(parseTile(text)) << text;
}

TEST(Tile, NegativeCubesBelongToNegativeTiles) {
  EXPECT_EQ(tileAt({-1, 0, 0}), (Tile{-1, 0}));
  EXPECT_EQ(tileAt({-kTileCells, kTileCells, 5}), (Tile{-1, 1}));
  EXPECT_EQ(tileAt({-kTileCells - 1, kTileCells - 1, 5}), (Tile{-2, 0}));
}

}  // namespace
}  // namespace laser_mapper
