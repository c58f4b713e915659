// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

/// How the robot moves at one time. All from one twice differentiable function of time, so they agree exactly.
struct MotionState {
  urban_nav_core::Pose T_world_base;   ///< base_link: on the ground between the wheels, x forward, y left
  Eigen::Vector3d velocity_world;      ///< of base_link, m/s
  Eigen::Vector3d acceleration_world;  ///< m/s^2, gravity not included
  Eigen::Vector3d rate_base;           ///< angular, in the axes of base_link, rad/s
  Eigen::Vector3d rate_change_base;    ///< its derivative there, rad/s^2
};

/// The true way of a session. Immutable, so thread-safe.
class Motion {
 public:
  virtual ~Motion() = default;
  virtual double duration() const = 0;  ///< s
  /// `t`: 0 ... duration(), s; a little outside (0.1 s) is allowed.
  virtual MotionState at(double t) const = 0;
};

}  // namespace urban_nav_sim
