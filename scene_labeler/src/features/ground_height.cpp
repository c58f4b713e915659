// SPDX-License-Identifier: BSD-3-Clause
#include "features/ground_height.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

using urban_nav_registration::CellTable;

constexpr float kColumnEdge = 0.5F;   // m
constexpr float kGroundSlope = 0.2F;  // steeper ground is rare on campuses and streets
constexpr int kGroundReach = 30;      // columns: 15 m

constexpr float kRaised = 0.5F;                  // m: kerbs and meadows are lower, vehicles and hedges higher
constexpr std::size_t kMostColumnsWithin1 = 13;  // integer places within two columns

SurroundingTops summariseTops(const float* tops, std::size_t count, float low) {
  SurroundingTops result;
  std::size_t raised = 0;
  for (std::size_t i = 0; i < count; ++i) {
    result.highest_1 = std::max(result.highest_1, tops[i] - low);
    raised += tops[i] - low > kRaised ? 1U : 0U;
  }
  result.raised_1 = static_cast<float>(raised) / static_cast<float>(count);
  return result;
}

std::uint64_t columnKey(int x, int y) { return urban_nav_registration::toKey({x, y, 0}); }

}  // namespace

void writeHeights(const ColumnHeights& heights, float* out) {
  out[0] = heights.over_ground;
  out[1] = heights.over_lowest_1;
  out[2] = heights.over_lowest_3;
  out[3] = heights.below_highest;
  out[4] = heights.column_extent;
  out[5] = heights.filled;
}

std::uint32_t ColumnGrid::add(const Eigen::Vector3f& mean) {
  const int x = static_cast<int>(std::floor(mean.x() / kColumnEdge)),
            y = static_cast<int>(std::floor(mean.y() / kColumnEdge));
  const std::uint32_t number = table_.insert(columnKey(x, y));
  if (number == columns_.size()) {
    columns_.push_back({x, y, mean.z(), mean.z(), 0.0F});
    if (coarse_table_.insert(columnKey(x >> 2, y >> 2)) == lowest_.size()) lowest_.push_back(number);
  }
  columns_[number].cubes += 1.0F;
  extend(number, mean.z());
  return number;
}

void ColumnGrid::extend(std::uint32_t number, float z) {
  Column& column = columns_[number];
  column.high = std::max(column.high, z);
  column.low = std::min(column.low, z);
  std::uint32_t& lowest = lowest_[coarse_table_.find(columnKey(column.x >> 2, column.y >> 2))];
  const float low = columns_[lowest].low;
  if (column.low < low || (column.low == low && number < lowest)) lowest = number;
}

// Columns within reach are searched directly, because a distance transform would process their bounding rectangle,
// which may be long and thin.
ColumnGrid::Surrounding ColumnGrid::measureSurrounding(std::uint32_t number) const {
  const Column& column = columns_[number];
  Surrounding result{column.low, column.low, column.low, column.high, {}};
  std::array<float, kMostColumnsWithin1> tops{};
  std::size_t count = 0;
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      const int square = i * i + j * j;
      if (square > 36) continue;
      const std::uint32_t other = table_.find(columnKey(column.x + i, column.y + j));
      if (other == CellTable::kNone) continue;
      const Column& neighbour = columns_[other];
      result.low_3 = std::min(result.low_3, neighbour.low);
      if (square > 4) continue;
      tops[count++] = neighbour.high;
      result.low_1 = std::min(result.low_1, neighbour.low);
      result.high_1 = std::max(result.high_1, neighbour.high);
    }
  result.tops = summariseTops(tops.data(), count, result.low_3);
  constexpr int kCoarseReach = kGroundReach / 4;  // of squares of four columns
  for (int j = -kCoarseReach; j <= kCoarseReach; ++j)
    for (int i = -kCoarseReach; i <= kCoarseReach; ++i) {
      const std::uint32_t other = coarse_table_.find(columnKey((column.x >> 2) + i, (column.y >> 2) + j));
      if (other == CellTable::kNone) continue;
      const Column& lowest = columns_[lowest_[other]];
      const float dx = static_cast<float>(lowest.x - column.x), dy = static_cast<float>(lowest.y - column.y);
      result.ground = std::min(result.ground, lowest.low + kGroundSlope * kColumnEdge * std::hypot(dx, dy));
    }
  return result;
}

ColumnHeights ColumnGrid::measureHeights(std::uint32_t number, const Surrounding& around, float z, float edge) const {
  const Column& column = columns_[number];
  const float extent = column.high - column.low;
  return {z - around.ground, z - around.low_1, z - around.low_3,
          around.high_1 - z, extent,           column.cubes / (extent / edge + 1.0F),
          around.tops};
}

std::vector<ColumnHeights> measureHeights(const CubeLevel& level) {
  ColumnGrid grid(level.cubes.size() / 8 + 16);
  std::vector<std::uint32_t> column_of;
  column_of.reserve(level.cubes.size());
  for (const Moments& cube : level.cubes) column_of.push_back(grid.add(cube.mean().cast<float>()));
  std::vector<ColumnGrid::Surrounding> surroundings(grid.size());
  urban_nav_core::forEach(grid.size(), 256, [&](std::size_t i) {
    surroundings[i] = grid.measureSurrounding(static_cast<std::uint32_t>(i));
  });
  std::vector<ColumnHeights> heights(level.cubes.size());
  for (std::size_t i = 0; i < level.cubes.size(); ++i)
    heights[i] = grid.measureHeights(column_of[i], surroundings[column_of[i]],
                                     static_cast<float>(level.cubes[i].mean().z()), level.edge);
  return heights;
}

}  // namespace scene_labeler
