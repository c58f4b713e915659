// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace laser_mapper {

/// Value of the cells of a Raster about which nothing is known; the usual one of height models (GDAL, ArcGIS).
constexpr float kNoValue = -9999.0F;

/// Values on the cells of a grid, rows from the south.
struct Raster {
  int width = 0, height = 0;
  double x0 = 0.0, y0 = 0.0;  ///< m, south-western corner
  double cell = 0.1;          ///< m, edge of a cell
  std::vector<float> values;  ///< kNoValue where unknown

  std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  bool isInside(int u, int v) const { return u >= 0 && v >= 0 && u < width && v < height; }
  bool isKnown(int u, int v) const { return isInside(u, v) && values[at(u, v)] != kNoValue; }
};

/// Returns a raster of the same cells without values.
Raster emptyLike(const Raster& raster);

/// Returns the part of a raster within a margin around its known cells; a single cell if none is known.
Raster cropped(const Raster& raster, int margin = 0);

}  // namespace laser_mapper
