// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "features/cube_moments.hpp"

namespace scene_labeler {

/// Tops of the squares of 0.5 m within 1 m of the vertical through a return, over the lowest return within 3 m.
struct SurroundingTops {
  float highest_1 = 0.0F;  ///< m
  float raised_1 = 0.0F;   ///< share of the squares that hold returns higher than 0.5 m
};

/// Heights around a return, m.
struct ColumnHeights {
  float over_ground = 0.0F;    ///< above the lower envelope of the cloud, which rises by at most 0.2 per m
  float over_lowest_1 = 0.0F;  ///< above the lowest return within 1 m of the vertical through the return
  float over_lowest_3 = 0.0F;  ///< within 3 m
  float below_highest = 0.0F;  ///< below the highest return within 1 m
  float column_extent = 0.0F;  ///< of the returns in the surrounding square of 0.5 m
  float filled = 0.0F;         ///< share of the cubes of 0.2 m between the lowest and the highest return of the square
  SurroundingTops tops;
};

constexpr std::size_t kHeightLevel = 1;   ///< level of the cubes from which heights are computed: 0.2 m
constexpr std::size_t kHeightValues = 6;  ///< features

/// Writes the kHeightValues features, without the tops.
void writeHeights(const ColumnHeights& heights, float* out);

/// Columns of 0.5 m with the lowest and highest of their cubes. Cubes can be added and can move.
class ColumnGrid {
 public:
  /// Heights of the lower envelope at a column.
  struct Surrounding {
    float ground = 0.0F, low_1 = 0.0F, low_3 = 0.0F, high_1 = 0.0F;
    SurroundingTops tops;
  };

  explicit ColumnGrid(std::size_t expected = 16) : table_(expected), coarse_table_(expected / 8 + 16) {}

  /// Adds the mean of a cube. Returns the number of its column.
  std::uint32_t add(const Eigen::Vector3f& mean);
  /// Extends a column to the new mean of one of its cubes.
  void extend(std::uint32_t column, float z);
  std::size_t size() const { return columns_.size(); }

  Surrounding measureSurrounding(std::uint32_t column) const;
  /// Returns the heights at `z` in a column. `edge`: of the cubes.
  ColumnHeights measureHeights(std::uint32_t column, const Surrounding& around, float z, float edge) const;

 private:
  struct Column {
    int x = 0, y = 0;
    float low = 0.0F, high = 0.0F;
    float cubes = 0.0F;
  };

  urban_nav_registration::CellTable table_, coarse_table_;
  std::vector<Column> columns_;
  std::vector<std::uint32_t> lowest_;  // column of each square of four by four; the first of equal ones
};

/// Computes the heights around every cube of the height level.
std::vector<ColumnHeights> measureHeights(const CubeLevel& level);

}  // namespace scene_labeler
