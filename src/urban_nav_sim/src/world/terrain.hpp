// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "world/site.hpp"

namespace urban_nav_sim {

/// Returns smooth ground, a sum of waves of 11 m and longer; zero at (0, 0). `relief`: amplitude of the longest wave,
/// m; at most 0.25 for the mesh to follow it.
std::function<double(double, double)> makeGround(std::uint64_t seed, double relief);

/// Extent of one kind of ground: positive inside, near the edge about the distance (m) to it.
struct Region {
  Finish finish;
  std::function<double(double x, double y)> inside;
};

struct Extent {
  double x0, y0, x1, y1;  ///< m
};

/// Meshes the ground in cells of 1/3 m (within 1 mm of World::ground), each region with its own appearance and cut at
/// its exact edge. Earlier regions take precedence over later ones; the last one fills the rest.
void layGround(Site& site, const Extent& extent, const std::vector<Region>& regions);

/// Meshes ground in cells of 6 m around the extent up to `reach` m, 0.15 m lower, so that no object floats.
void laySurroundings(Site& site, const Extent& extent, double reach, const Finish& finish);

/// Adds a strip along a straight line, `height` above the ground with sides down to it: pavements, kerbs, paint, beds.
void layStrip(Site& site, const Finish& top, const Finish& side, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double width, double height);

/// Returns `count` random rectangles of 0.8 to 5 m in an extent, as repairs of a road. As Region::inside.
std::function<double(double, double)> patches(const Extent& extent, int count, std::uint64_t seed);

double distanceTo(const std::vector<Eigen::Vector2d>& line, double x, double y);
/// Returns a value that is positive inside a rectangle with rounded corners.
double insideRectangle(const Extent& extent, double radius, double x, double y);

}  // namespace urban_nav_sim
