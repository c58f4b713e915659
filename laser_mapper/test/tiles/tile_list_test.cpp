// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/tile_list.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "urban_nav_store/deflate.hpp"

namespace laser_mapper {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

/// Two coarse tiles, and eight in a row along x at the finest level.
TileList rowOfTiles() {
  TileList list;
  list.voxel = 0.05;
  list.digest = "abc";
  list.sessions = {{"monday", 100}, {"tuesday", 7}};
  list.tiles.push_back({{2, {0, 0}}, 50, -5, 5, 0, 3});
  list.tiles.push_back({{2, {1, 0}}, 50, -5, 5, 1, 6});
  for (int x = 0; x < 8; ++x) list.tiles.push_back({{0, {x, 0}}, 1000, -9, 400, 0, 99});
  return list;
}

std::uint64_t countPoints(const std::vector<ListedTile>& tiles) {
  return std::accumulate(tiles.begin(), tiles.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const ListedTile& tile) { return sum + tile.points; });
}

TEST(ListOfTiles, ComesBackFromItsBytes) {
  const TileList list = rowOfTiles();
  const auto back = unpackTileList(packTileList(list));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->voxel, list.voxel);
  EXPECT_EQ(back->digest, list.digest);
  ASSERT_EQ(back->sessions.size(), 2U);
  EXPECT_EQ(back->sessions[1].session, "tuesday");
  EXPECT_EQ(back->sessions[1].poses, 7U);
  ASSERT_EQ(back->tiles.size(), 10U);
  EXPECT_TRUE((back->tiles[9].tile == LevelTile{0, {7, 0}}));
  EXPECT_EQ(back->tiles[9].lowest, -9);
  EXPECT_EQ(back->tiles[1].session, 1);
  EXPECT_EQ(back->tiles[1].pose, 6U);
  EXPECT_EQ(back->points(), 8100U);
}

TEST(ListOfTiles, DamagedBytesAreRefused) {
  const std::string bytes = *urban_nav_store::inflated(packTileList(rowOfTiles()), 1 << 20);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(unpackTileList(urban_nav_store::deflated(std::string_view(bytes).substr(0, size)))) << size;
  EXPECT_FALSE(unpackTileList(urban_nav_store::deflated(bytes + "x")));
  EXPECT_FALSE(unpackTileList("no list"));
}

TEST(ListOfTiles, AnExtentSelectsTheTilesThatReachIntoIt) {
  const TileList list = rowOfTiles();  // tiles of 12.8 m and of 51.2 m
  EXPECT_EQ(selectTiles(list, std::nullopt, kUnlimited).size(), 10U);
  const auto near = selectTiles(list, {{20.0, 1.0, 30.0, 2.0}}, kUnlimited);
  ASSERT_EQ(near.size(), 3U) << "one coarse tile, 12.8...25.6 m and 25.6...38.4 m";
  EXPECT_TRUE((near[0].tile == LevelTile{2, {0, 0}}));
  EXPECT_TRUE(selectTiles(list, {{0.0, 60.0, 100.0, 70.0}}, kUnlimited).empty());
}

TEST(ListOfTiles, ABudgetKeepsCoarseLevelsAndTheMiddle) {
  const TileList list = rowOfTiles();
  for (const std::uint64_t budget : {0U, 99U, 100U, 1100U, 3100U, 9000U})
    EXPECT_LE(countPoints(selectTiles(list, {{0.0, 0.0, 102.4, 12.8}}, budget)), budget);
  EXPECT_EQ(selectTiles(list, std::nullopt, 100).size(), 2U) << "the coarse level";
  const auto middle = selectTiles(list, {{0.0, 0.0, 102.4, 12.8}}, 2100);
  ASSERT_EQ(middle.size(), 4U);
  EXPECT_EQ(middle[2].tile.tile.x + middle[3].tile.tile.x, 7) << "those on both sides of 51.2 m";
}

}  // namespace
}  // namespace laser_mapper
