// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>

#include "spinning_lidar.hpp"

namespace laser_odometry {

/// Walls up to 3 m, as seen by a horizontal laser.
inline void addWall(double x0, double y0, double x1, double y1, BoxWorld& world) {
  world.boxes.push_back({{x0, y0, -1.0}, {x1, y1, 3.0}});
}

/// A closed room of 14 x 9 m with pillars, boxes and two recesses, seen from inside; the robot starts at its centre.
inline BoxWorld makeOffice(std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  BoxWorld world;
  addWall(-7.2, -4.7, 7.2, -4.5, world);
  addWall(-7.2, 4.5, 7.2, 4.7, world);
  addWall(-7.2, -4.7, -7.0, 4.7, world);
  addWall(7.0, -4.7, 7.2, 4.7, world);
  addWall(-2.0, 3.6, 0.5, 4.6, world);
  addWall(3.0, -4.6, 3.4, -3.2, world);
  for (int i = 0; i < 8; ++i) {  // along the walls, where the robot does not drive
    const double x = dice.uniform(-6.5, 6.0), side = i % 2 == 0 ? -1.0 : 1.0, y = side * dice.uniform(3.3, 4.0);
    addWall(x, y - 0.2, x + dice.uniform(0.2, 0.8), y + 0.2, world);
  }
  return world;
}

/// A hall of 60 x 40 m with rows of pillars and shelves of different lengths.
inline BoxWorld makeHall(std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  BoxWorld world;
  addWall(-30.2, -20.2, 30.2, -20.0, world);
  addWall(-30.2, 20.0, 30.2, 20.2, world);
  addWall(-30.2, -20.2, -30.0, 20.2, world);
  addWall(30.0, -20.2, 30.2, 20.2, world);
  for (double x = -27.0; x < 28.0; x += 6.0)
    for (const double y : {-12.0, -5.0, 5.0, 12.0}) {
      const double length = dice.chance(0.5) ? 0.4 : dice.uniform(1.0, 4.5);
      addWall(x, y - 0.2, x + length, y + 0.2, world);
    }
  return world;
}

/// An infinite corridor along x without any feature, 2.4 m wide.
inline BoxWorld makeCorridor() {
  BoxWorld world;
  addWall(-500.0, 1.2, 500.0, 1.4, world);
  addWall(-500.0, -1.4, 500.0, -1.2, world);
  return world;
}

/// A planar laser in the scan plane of its frame: 360 deg, 10 Hz, and noise as of sensors for indoor robots.
inline SpinningLidar makePlanarLaser(int beams = 720, double sigma_m = 0.01) {
  SpinningLidar laser;
  laser.rings = 1;
  laser.lowest_deg = laser.highest_deg = 0.0;
  laser.columns = beams;
  laser.sigma_m = sigma_m;
  laser.T_base_lidar = Pose(Eigen::Quaterniond::Identity(), {0.2, 0.0, 0.3});
  return laser;
}

/// A figure of eight of 2 `a` by 2 `b` m around the origin in `period` s, heading along the path.
inline std::function<Pose(double)> makeFigureEight(double a, double b, double period) {
  return [=](double t) {
    const double w = 2.0 * M_PI / period;
    const double dx = a * std::cos(w * t), dy = 2.0 * b * std::cos(2.0 * w * t);
    return Pose(urban_nav_core::expSo3({0.0, 0.0, std::atan2(dy, dx)}),
                {a * std::sin(w * t), b * std::sin(2.0 * w * t), 0.0});
  };
}

}  // namespace laser_odometry
