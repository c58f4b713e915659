// SPDX-License-Identifier: BSD-3-Clause
#include "features/ground_height.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

using urban_nav_registration::CellTable;

constexpr float kColumnEdge = 0.5F;   // m
constexpr float kGroundSlope = 0.2F;  // steeper ground is rare on campuses and streets
constexpr int kGroundReach = 30;      // columns: 15 m

struct Column {
  int x = 0, y = 0;
  float low = 0.0F, high = 0.0F;
  float cubes = 0.0F;
};

struct ColumnGrid {
  CellTable table{16};
  std::vector<Column> columns;
  std::vector<std::uint32_t> column_of;  // per cube
};

std::uint64_t columnKey(int x, int y) { return urban_nav_registration::toKey({x, y, 0}); }

ColumnGrid makeColumns(const CubeLevel& level) {
  ColumnGrid grid;
  grid.table = CellTable(level.cubes.size() / 8 + 16);
  grid.column_of.reserve(level.cubes.size());
  for (const Moments& cube : level.cubes) {
    const Eigen::Vector3f mean = cube.mean().cast<float>();
    const int x = static_cast<int>(std::floor(mean.x() / kColumnEdge)),
              y = static_cast<int>(std::floor(mean.y() / kColumnEdge));
    const std::uint32_t number = grid.table.insert(columnKey(x, y));
    if (number == grid.columns.size()) grid.columns.push_back({x, y, mean.z(), mean.z(), 0.0F});
    Column& column = grid.columns[number];
    column.low = std::min(column.low, mean.z());
    column.high = std::max(column.high, mean.z());
    column.cubes += 1.0F;
    grid.column_of.push_back(number);
  }
  return grid;
}

/// Heights of the lower envelope at each column. Columns within reach are looked up directly, because a distance
/// transform would process their bounding rectangle, which may be long and thin.
struct Surrounding {
  float ground = 0.0F, low_1 = 0.0F, low_3 = 0.0F, high_1 = 0.0F;
};

Surrounding measureSurrounding(const ColumnGrid& grid, const Column& column, const CellTable& coarse_table,
                               const std::vector<Column>& coarse) {
  Surrounding result{column.low, column.low, column.low, column.high};
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      const int square = i * i + j * j;
      if (square > 36) continue;
      const std::uint32_t other = grid.table.find(columnKey(column.x + i, column.y + j));
      if (other == CellTable::kNone) continue;
      const Column& neighbour = grid.columns[other];
      result.low_3 = std::min(result.low_3, neighbour.low);
      if (square > 4) continue;
      result.low_1 = std::min(result.low_1, neighbour.low);
      result.high_1 = std::max(result.high_1, neighbour.high);
    }
  constexpr int kCoarseReach = kGroundReach / 4;  // of squares of four columns
  for (int j = -kCoarseReach; j <= kCoarseReach; ++j)
    for (int i = -kCoarseReach; i <= kCoarseReach; ++i) {
      const std::uint32_t other = coarse_table.find(columnKey((column.x >> 2) + i, (column.y >> 2) + j));
      if (other == CellTable::kNone) continue;
      const Column& lowest = coarse[other];
      const float dx = static_cast<float>(lowest.x - column.x), dy = static_cast<float>(lowest.y - column.y);
      result.ground = std::min(result.ground, lowest.low + kGroundSlope * kColumnEdge * std::hypot(dx, dy));
    }
  return result;
}

}  // namespace

std::vector<ColumnHeights> measureHeights(const CubeLevel& level) {
  const ColumnGrid grid = makeColumns(level);
  CellTable coarse_table(grid.columns.size() / 8 + 16);
  std::vector<Column> coarse;  // lowest column of each square of four by four
  for (const Column& column : grid.columns) {
    const std::uint32_t number = coarse_table.insert(columnKey(column.x >> 2, column.y >> 2));
    if (number == coarse.size()) coarse.push_back(column);
    else if (column.low < coarse[number].low) coarse[number] = column;
  }
  std::vector<Surrounding> surroundings(grid.columns.size());
  urban_nav_core::forEach(grid.columns.size(), 256, [&](std::size_t i) {
    surroundings[i] = measureSurrounding(grid, grid.columns[i], coarse_table, coarse);
  });
  std::vector<ColumnHeights> heights(level.cubes.size());
  for (std::size_t i = 0; i < level.cubes.size(); ++i) {
    const Column& column = grid.columns[grid.column_of[i]];
    const Surrounding& around = surroundings[grid.column_of[i]];
    const float z = static_cast<float>(level.cubes[i].mean().z());
    const float extent = column.high - column.low;
    heights[i] = {z - around.ground, z - around.low_1, z - around.low_3,
                  around.high_1 - z, extent,           column.cubes / (extent / level.edge + 1.0F)};
  }
  return heights;
}

}  // namespace scene_labeler
