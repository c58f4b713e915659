// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "world/site.hpp"

namespace urban_nav_sim {

/// Gentle ground, a sum of waves of 11 m and longer: any number of times differentiable; zero at (0, 0).
/// `relief`: amplitude of the longest wave, m; at most 0.25 for the mesh to follow it.
std::function<double(double, double)> makeGround(std::uint64_t seed, double relief);

/// Where one kind of ground lies: positive inside, about the distance (m) to its edge nearby.
struct Region {
  Finish finish;
  std::function<double(double x, double y)> inside;
};

struct Extent {
  double x0, y0, x1, y1;  ///< m
};

/// Meshes the ground in cells of 1/3 m (it strays from World::ground by less than 1 mm), each region with its own look;
/// edges of regions are cut, not stepped. Earlier regions lie above later ones; the last one is everywhere else.
void layGround(Site& site, const Extent& extent, const std::vector<Region>& regions);

/// Coarse ground of 6 m cells around the extent as far as `reach` m, 0.15 m lower, so that nothing ends in the air.
void laySurroundings(Site& site, const Extent& extent, double reach, const Finish& finish);

/// A strip along a straight line, `height` above the ground and with sides down to it: pavements, kerbs, paint, beds.
void layStrip(Site& site, const Finish& top, const Finish& side, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              double width, double height);

/// `count` rectangles of 0.8 to 5 m strewn over an extent: where a road was opened and mended. As Region::inside.
std::function<double(double, double)> patches(const Extent& extent, int count, std::uint64_t seed);

double distanceTo(const std::vector<Eigen::Vector2d>& line, double x, double y);
/// Positive inside a rectangle with rounded corners.
double insideRectangle(const Extent& extent, double radius, double x, double y);

}  // namespace urban_nav_sim
