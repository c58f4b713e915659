// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_sim {

/// A Segway as two wheels with a rigid body on their axle: where it is and how it moves.
struct SegwayState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of the axle's middle, m, in `world`
  double yaw = 0.0;                                    ///< rad, not wrapped, so that it is a smooth function of time
  double speed = 0.0;                                  ///< of the axle along the ground, m/s
  double turn = 0.0;                                   ///< rad/s
  double pitch = 0.0;       ///< of the body from the vertical, rad, positive forward (REP-103)
  double pitch_rate = 0.0;  ///< rad/s
};

/// What the driver asks for.
struct SegwayCommand {
  double speed = 0.0;  ///< m/s
  double turn = 0.0;   ///< rad/s
};

/// What pushes it besides.
struct SegwayDisturbance {
  double slope = 0.0;       ///< of the ground ahead, rad, uphill positive
  double pitch_push = 0.0;  ///< rad/s^2
  double turn_push = 0.0;   ///< rad/s^2
};

/// At rest on a slope (rad, uphill positive), with the lean that it needs there.
SegwayState standingSegway(const Eigen::Vector2d& position, double yaw, double slope);

/// One step of `dt` seconds (at most 0.01). The body is an inverted pendulum of equivalent length L whose foot the
/// wheels accelerate by a; the ground pushes where the wheel touches, on a slope in front of the axle by r sin(slope):
///   L pitch'' = g sin(pitch) - a cos(pitch) - g r / l sin(slope)
/// (textbook cart and pole with the axle's acceleration as input; Grasser et al., JOE: a mobile, inverted pendulum,
/// 2002, has the masses). The base's own controller balances: state feedback with both poles at 4 rad/s, damping 0.7,
/// about the lean that accelerates towards the wanted speed. So the robot leans into every acceleration, and before it
/// moves forward it rolls back a little.
SegwayState stepSegway(const SegwayState& state, const SegwayCommand& command, const SegwayDisturbance& disturbance,
                       double dt);

}  // namespace urban_nav_sim
