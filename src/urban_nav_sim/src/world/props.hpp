// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "noise/hash.hpp"
#include "world/site.hpp"

namespace urban_nav_sim {

/// Objects on the ground at (x, y). `seed` selects the variant.
void plantTree(Site& site, double x, double y, double height, std::uint64_t seed);
/// A clipped hedge along a line, or a shrub if the line is short: rounded, uneven, with loose leaves at its surface.
void plantHedge(Site& site, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, double height,
                MaterialKind stuff, std::uint64_t seed);
/// A belt of trees and undergrowth to the right of a line, which closes the view.
void plantBelt(Site& site, const std::vector<Eigen::Vector2d>& line, std::uint64_t seed);
void placeLamp(Site& site, double x, double y, double yaw);
void placeBench(Site& site, double x, double y, double yaw);
void placeBin(Site& site, double x, double y);

/// A car (with `van`, a delivery van) heading along +x, centre at the origin, wheels on z = 0.
void makeCar(Site& site, bool van, std::uint64_t seed);
/// A parked car.
void parkCar(Site& site, double x, double y, double yaw, bool van, std::uint64_t seed);

/// A pedestrian walking back and forth along a line at `speed` m/s; `phase` (0 ... 1): position at t = 0.
void sendWalker(Site& site, const std::vector<Eigen::Vector2d>& line, double speed, double phase, std::uint64_t seed);
/// A car that drives along a line and back; it rotates on the spot, so the ends should be out of sight.
void sendCar(Site& site, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double speed, double phase,
             std::uint64_t seed);
/// Cars in a row that drive along a line at one speed (m/s), repeatedly. Its ends must be out of sight.
void sendTraffic(Site& site, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double speed, int cars,
                 Draw& draw);

/// m
constexpr double kCarLength = 4.2, kCarWidth = 1.8;

}  // namespace urban_nav_sim
