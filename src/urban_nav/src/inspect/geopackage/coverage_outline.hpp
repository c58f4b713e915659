// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "inspect/geopackage/geopackage_file.hpp"

namespace urban_nav {

/// Cell of a grid of a given width, by its lower corner in units of that width.
using GridCell = std::pair<int, int>;

/// Returns the cells of width `cell` whose centres are within `reach` of a path, m.
std::set<GridCell> cellsAround(const std::vector<Eigen::Vector2d>& path, double reach, double cell);

/// An area as polygons with their holes.
struct Coverage {
  std::vector<Geometry::Polygon> polygons;
  double area_m2 = 0.0;
};

/// Returns the area within `reach` of a path, on a grid of cells of width `cell`, m. Polygons do not overlap and
/// touch at most at corners.
Coverage coverageAround(const std::vector<Eigen::Vector2d>& path, double reach, double cell);

}  // namespace urban_nav
