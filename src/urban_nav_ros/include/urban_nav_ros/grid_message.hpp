// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_ros {

/// Cells of a grid, rows from the south.
struct GridCells {
  int width = 0, height = 0;
  double x0 = 0.0, y0 = 0.0;  ///< m, south-western corner
  double cell = 0.0;          ///< m, edge of a cell
};

/// `values`: 0 free ... 100 occupied, -1 unknown.
nav_msgs::OccupancyGrid toGridMessage(const GridCells& cells, std::vector<std::int8_t> values, const std::string& frame,
                                      urban_nav_core::StampNs stamp);

}  // namespace urban_nav_ros
