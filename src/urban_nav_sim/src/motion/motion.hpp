// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

/// State of motion at one time. All from one twice differentiable function of time, so they are exactly consistent.
struct MotionState {
  urban_nav_core::Pose T_world_base;   ///< base_link: on the ground, midway between the wheels, x forward, y left
  Eigen::Vector3d velocity_world;      ///< of base_link, m/s
  Eigen::Vector3d acceleration_world;  ///< m/s^2, without gravity
  Eigen::Vector3d rate_base;           ///< angular velocity in the axes of base_link, rad/s
  Eigen::Vector3d rate_change_base;    ///< its derivative in the same axes, rad/s^2
};

/// True motion of a session. Immutable, so thread-safe.
class Motion {
 public:
  virtual ~Motion() = default;
  virtual double duration() const = 0;  ///< s
  /// `t`: 0 ... duration(), s; up to 0.1 s outside is allowed.
  virtual MotionState at(double t) const = 0;
};

}  // namespace urban_nav_sim
