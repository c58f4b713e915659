// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace laser_odometry {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

/// A half space, or the inside or outside of a box: elements of rooms and streets. Surfaces are exact planes.
struct Wall {
  Vector3d low, high;  ///< corners of an axis-parallel box, m
};

/// A world of boxes, seen from outside each of them.
struct BoxWorld {
  std::vector<Wall> boxes;

  /// Distance along a unit direction to the first box; negative: none within 120 m.
  double trace(const Vector3d& origin, const Vector3d& direction) const {
    double nearest = 120.0;
    bool is_hit = false;
    for (const Wall& box : boxes) {
      double enter = 1e-6, leave = nearest;
      for (int i = 0; i < 3 && enter < leave; ++i) {
        const double inverse = 1.0 / (std::abs(direction[i]) < 1e-12 ? 1e-12 : direction[i]);
        const double a = (box.low[i] - origin[i]) * inverse, b = (box.high[i] - origin[i]) * inverse;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      }
      if (enter >= leave || enter <= 1e-6) continue;
      nearest = enter;
      is_hit = true;
    }
    return is_hit ? nearest : -1.0;
  }
};

/// Ground z = 0 with house fronts on both sides, set back by different lengths, and boxes on the pavement.
inline BoxWorld makeStreet(std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  BoxWorld world;
  world.boxes.push_back({{-200, -200, -1}, {400, 200, 0}});
  for (int side = -1; side <= 1; side += 2) {
    for (double x = -60.0; x < 160.0;) {
      const double length = dice.uniform(6.0, 14.0), back = dice.uniform(8.0, 12.0), height = dice.uniform(6.0, 12.0);
      const double near = side * back, far = side * (back + 10.0);
      world.boxes.push_back(
          {{x, std::min(near, far), 0}, {x + length - dice.uniform(0.0, 2.0), std::max(near, far), height}});
      x += length;
    }
    for (double x = -50.0; x < 150.0; x += dice.uniform(7.0, 16.0)) {
      const double y = side * dice.uniform(4.5, 6.5);
      world.boxes.push_back({{x, y - 0.9, 0}, {x + dice.uniform(1.0, 4.0), y + 0.9, dice.uniform(1.2, 2.5)}});
    }
  }
  return world;
}

/// A smooth, infinite tunnel along x, 6 m wide and 5 m high.
inline BoxWorld makeTunnel() {
  BoxWorld world;
  world.boxes.push_back({{-500, -10, -1}, {500, 10, 0}});
  world.boxes.push_back({{-500, -10, 5}, {500, 10, 6}});
  world.boxes.push_back({{-500, 3, -1}, {500, 4, 6}});
  world.boxes.push_back({{-500, -4, -1}, {500, -3, 6}});
  return world;
}

/// Infinite level ground.
inline BoxWorld makeField() {
  BoxWorld world;
  world.boxes.push_back({{-500, -500, -1}, {500, 500, 0}});
  return world;
}

/// A closed room of 16 x 12 x 4 m with some furniture.
inline BoxWorld makeRoom() {
  BoxWorld world;
  world.boxes.push_back({{-9, -7, -1}, {9, 7, 0}});
  world.boxes.push_back({{-9, -7, 4}, {9, 7, 5}});
  world.boxes.push_back({{-9, -7, 0}, {-8, 7, 4}});
  world.boxes.push_back({{8, -7, 0}, {9, 7, 4}});
  world.boxes.push_back({{-9, -7, 0}, {9, -6, 4}});
  world.boxes.push_back({{-9, 6, 0}, {9, 7, 4}});
  world.boxes.push_back({{4, 2, 0}, {6, 5, 1.2}});
  world.boxes.push_back({{-6, -5, 0}, {-5, -2, 2.0}});
  return world;
}

/// A spinning LiDAR on a moving base: rings of beams from backwards over the left... to backwards, each with its time.
struct SpinningLidar {
  int rings = 16, columns = 900;
  double lowest_deg = -20.0, highest_deg = 12.0;
  double sweep_s = 0.1;
  double sigma_m = 0.01;
  double ring_range_sigma_m = 0.0, ring_angle_sigma = 0.0;  ///< m, rad: constant errors of the rings
  Pose T_base_lidar;

  /// Returns the sweep whose middle is at `reference_s` along a motion T_world_base(t).
  Sweep scan(const BoxWorld& world, const std::function<Pose(double)>& T_world_base, double reference_s,
             std::uint64_t seed) const {
    urban_nav_core::testing::Dice dice(seed * 7919 + static_cast<std::uint64_t>(std::llround(reference_s * 1000.0)));
    std::vector<double> range_errors, elevation_errors;
    urban_nav_core::testing::Dice constants(7);
    for (int ring = 0; ring < rings; ++ring) {
      range_errors.push_back(ring_range_sigma_m * constants.normal());
      elevation_errors.push_back(ring_angle_sigma * constants.normal());
    }
    Sweep sweep;
    sweep.reference = toStamp(reference_s);
    sweep.duration = sweep_s;
    sweep.times = Sweep::Times::Measured;
    for (int column = 0; column < columns; ++column) {
      const double share = (column + 0.5) / columns;
      const double azimuth = M_PI * (1.0 - 2.0 * share);
      const double time = reference_s + sweep_s * (share - 0.5);
      const Pose T = T_world_base(time) * T_base_lidar;
      for (int ring = 0; ring < rings; ++ring) {
        const double elevation =
            (lowest_deg + (highest_deg - lowest_deg) * ring / std::max(1, rings - 1)) * M_PI / 180.0;
        const auto direction = [azimuth](double angle) {
          return Vector3d(std::cos(angle) * std::cos(azimuth), std::cos(angle) * std::sin(azimuth), std::sin(angle));
        };
        const auto i = static_cast<std::size_t>(ring);
        const Vector3d d = direction(elevation);
        const double range = world.trace(T.t(), T.q() * direction(elevation + elevation_errors[i])) + range_errors[i] +
                             sigma_m * dice.normal();
        if (range < 0.3) continue;
        urban_nav_core::Beam beam;
        beam.stamp = toStamp(time);
        beam.direction = d.cast<float>();
        beam.range = static_cast<float>(range);
        beam.ring = static_cast<std::uint16_t>(ring);
        beam.column = static_cast<std::uint16_t>(column);
        sweep.beams.push_back(beam);
      }
    }
    return sweep;
  }

  static StampNs toStamp(double seconds) { return 1700000000000000000 + std::llround(seconds * 1e9); }
};

/// A base 1.7 m above the ground that moves at `speed` (m/s) and turns at `rate` (rad/s), from the origin.
inline std::function<Pose(double)> makeDrive(double speed, double rate) {
  return [speed, rate](double t) {
    Vector6d twist;
    twist << speed, 0, 0, 0, 0, rate;
    return Pose(Eigen::Quaterniond::Identity(), Vector3d(0, 0, 1.7)) * urban_nav_core::expSe3(twist * t);
  };
}

/// makeDrive() with a sway of `amplitude` (rad) in roll at `hz`, as of a vehicle on soft springs.
inline std::function<Pose(double)> makeSwayingDrive(double speed, double amplitude, double hz) {
  const std::function<Pose(double)> drive = makeDrive(speed, 0.0);
  return [drive, amplitude, hz](double t) {
    return drive(t) *
           Pose(urban_nav_core::expSo3({amplitude * std::sin(2.0 * M_PI * hz * t), 0.0, 0.0}), Vector3d::Zero());
  };
}

}  // namespace laser_odometry
