// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "scanned_room.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace laser_mapper::testing_room {

constexpr double kRoundsX = 8.6, kRoundsY = 4.6;  // m, half axes of the ellipse
constexpr double kRoundLength = 42.4;             // m: longer than the shortest pass
constexpr double kRoundsSpeed = 1.2;              // m/s, mean
constexpr double kRoundsTime = 80.0;              // s: two rounds and a quarter

/// Rounds through the room, 1.4 m from its walls; poses every 50 ms.
inline urban_nav_core::Trajectory driveRounds() {
  urban_nav_core::Trajectory trajectory;
  for (int i = 0; i <= static_cast<int>(20.0 * kRoundsTime); ++i) {
    const double angle = 2.0 * M_PI * kRoundsSpeed / kRoundLength * 0.05 * i;
    const double heading = std::atan2(kRoundsY * std::cos(angle), -kRoundsX * std::sin(angle));
    trajectory.append(kRoomStart + static_cast<StampNs>(i) * 50'000'000,
                      Pose(Eigen::Quaterniond(Eigen::AngleAxisd(heading, Vector3d::UnitZ())),
                           Vector3d(kRoundsX * std::cos(angle), kRoundsY * std::sin(angle), 0.0)));
  }
  return trajectory;
}

/// Laser 1 m up whose scan plane is upright and across the direction of travel, facing right: outwards.
inline Pose outwardLaser() {
  Eigen::Matrix3d R;
  R.col(0) = -Vector3d::UnitY();
  R.col(1) = Vector3d::UnitZ();
  R.col(2) = -Vector3d::UnitX();
  return Pose(R, Vector3d(0.0, 0.0, 1.0));
}

/// The truth with a growing displacement: at the end `largest` (m) and a twentieth of it (rad, about z).
inline urban_nav_core::Trajectory driftFrom(const urban_nav_core::Trajectory& truth, double largest) {
  urban_nav_core::Trajectory trajectory;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(truth.size());
    urban_nav_core::Vector6d drift;
    drift << 0.8, -0.6, 0.3, 0.0, 0.0, 0.05;
    trajectory.append(truth[i].stamp, urban_nav_core::boxPlus(truth[i].pose, share * largest * drift));
  }
  return trajectory;
}

}  // namespace laser_mapper::testing_room
