// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper::testing_room {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

/// A room whose walls are x = +-10, y = +-6, floor z = 0 and ceiling z = 4, m.
inline double distanceToRoom(const Vector3d& p) {
  return std::min(
      {std::abs(10.0 - std::abs(p.x())), std::abs(6.0 - std::abs(p.y())), std::abs(p.z()), std::abs(4.0 - p.z())});
}

inline double rangeInRoom(const Vector3d& origin, const Vector3d& direction) {
  double range = std::numeric_limits<double>::infinity();
  const Vector3d low(-10.0, -6.0, 0.0), high(10.0, 6.0, 4.0);
  for (int axis = 0; axis < 3; ++axis)
    for (const double wall : {low[axis], high[axis]}) {
      const double t = (wall - origin[axis]) / direction[axis];
      if (t > 0.0) range = std::min(range, t);
    }
  return range;
}

constexpr StampNs kRoomStart = 1'000'000'000'000;

/// The robot drives along x from -5 m at 0.5 m/s and turns slowly; poses every 50 ms.
inline urban_nav_core::Trajectory driveThroughRoom(double seconds, double speed = 0.5) {
  urban_nav_core::Trajectory trajectory;
  for (int i = 0; i <= static_cast<int>(seconds * 20.0); ++i) {
    const double t = 0.05 * i;
    trajectory.append(kRoomStart + static_cast<StampNs>(i) * 50'000'000,
                      Pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.05 * std::sin(0.7 * t), Vector3d::UnitZ())),
                           Vector3d(-5.0 + speed * t, 0.3 * std::sin(0.5 * t), 0.0)));
  }
  return trajectory;
}

/// Laser 1 m up whose scan plane is upright and across the direction of travel, facing left.
inline Pose roomLaser() {
  Eigen::Matrix3d R;
  R.col(0) = Vector3d::UnitY();
  R.col(1) = Vector3d::UnitZ();
  R.col(2) = Vector3d::UnitX();
  return Pose(R, Vector3d(0.0, 0.0, 1.0));
}

/// One scan of 181 beams from -45 to 45 deg at 75 Hz, the first beam at `stamp`, with noise of `sigma` (m).
inline urban_nav_core::Scan scanRoom(const urban_nav_core::Trajectory& T_map_base, const Pose& T_base_laser,
                                     StampNs stamp, double sigma, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 1.0);
  urban_nav_core::Scan scan;
  scan.stamp = stamp;
  for (int i = 0; i <= 180; ++i) {
    urban_nav_core::Beam beam;
    beam.stamp = stamp + static_cast<StampNs>(i) * 18'500;
    const double angle = (-45.0 + 0.5 * i) * M_PI / 180.0;
    const Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
    const auto T_map_base_now = T_map_base.at(beam.stamp, 1'000'000'000);
    if (!T_map_base_now) continue;
    const Pose T_map_laser = *T_map_base_now * T_base_laser;
    beam.direction = direction.cast<float>();
    beam.range = static_cast<float>(rangeInRoom(T_map_laser.t(), T_map_laser.q() * direction) + sigma * noise(random));
    beam.intensity = 100.0F;
    scan.beams.push_back(beam);
  }
  return scan;
}

inline std::vector<urban_nav_core::Scan> scansOfRoom(const urban_nav_core::Trajectory& T_map_base,
                                                     const Pose& T_base_laser, double sigma) {
  std::mt19937 random(7);
  std::vector<urban_nav_core::Scan> scans;
  for (StampNs stamp = T_map_base.front().stamp; stamp < T_map_base.back().stamp - 20'000'000; stamp += 13'333'333)
    scans.push_back(scanRoom(T_map_base, T_base_laser, stamp, sigma, random));
  return scans;
}

}  // namespace laser_mapper::testing_room
