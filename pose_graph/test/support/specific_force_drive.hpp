// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "pose_graph/level.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph::testing {

constexpr double kGravity = 9.81, kStep = 0.05;  // m/s2, s
constexpr urban_nav_core::StampNs kStepNs = 50'000'000;

/// A drive over hills in a level world: it rotates at a constant rate, sways and rocks.
struct Drive {
  double turning = 0.3;  // rad/s
  double rocking = 1.0;
  int frames = 2000;
  Eigen::Matrix3d lean =
      urban_nav_core::expSo3(Eigen::Vector3d(0.1, -0.06, 0.0)).toRotationMatrix();  // of the first pose
  Eigen::Vector3d fault = Eigen::Vector3d::Zero();                                  // accelerometer bias, m/s2
  double noise = 0.0;                                                               // m/s2, of the mean of each frame

  Eigen::Vector3d position(double t) const {
    const Eigen::Vector3d along =
        turning != 0.0 ? Eigen::Vector3d(std::sin(turning * t), 1.0 - std::cos(turning * t), 0.0) / turning
                       : Eigen::Vector3d(t, 0.0, 0.0);
    return 1.2 * along + Eigen::Vector3d(0.0, 0.0, 0.4 * std::sin(0.5 * t) + 0.02 * std::sin(4.0 * t));
  }
  Eigen::Matrix3d rotation(double t) const {
    return urban_nav_core::expSo3(Eigen::Vector3d(0.0, 0.0, turning * t)).toRotationMatrix() * lean *
           urban_nav_core::expSo3(rocking * Eigen::Vector3d(0.05 * std::sin(1.1 * t), 0.08 * std::sin(0.7 * t), 0.0))
               .toRotationMatrix();
  }
  urban_nav_core::Pose pose(double t) const {
    return urban_nav_core::Pose(Eigen::Quaterniond(rotation(t)), position(t));
  }
  /// Returns the trajectory relative to the first pose, as odometry.
  urban_nav_core::Trajectory trajectory() const {
    urban_nav_core::Trajectory made;
    for (int i = 0; i < frames; ++i) made.append(i * kStepNs, pose(0.0).inverse() * pose(i * kStep));
    return made;
  }
  std::vector<SpecificForce> forces(urban_nav_core::testing::Dice& dice) const {
    constexpr double kH = 1e-3;
    std::vector<SpecificForce> made;
    for (int i = 0; i < frames; ++i) {
      const double t = i * kStep;
      const Eigen::Vector3d acceleration = (position(t + kH) - 2.0 * position(t) + position(t - kH)) / (kH * kH);
      made.push_back({i * kStepNs, rotation(t).transpose() * (acceleration + Eigen::Vector3d(0, 0, kGravity)) + fault +
                                       noise * dice.normals<3>()});
    }
    return made;
  }
  Eigen::Vector3d trueUp() const { return rotation(0.0).transpose() * Eigen::Vector3d::UnitZ(); }
  Level level(urban_nav_core::testing::Dice& dice) const { return estimateLevel(trajectory(), forces(dice)); }
};

}  // namespace pose_graph::testing
