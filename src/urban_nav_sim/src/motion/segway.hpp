// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_sim {

/// State of a Segway, modelled as two wheels with a rigid body on their axle.
struct SegwayState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of the centre of the axle, m, in `world`
  double yaw = 0.0;                                    ///< rad, not wrapped, hence a smooth function of time
  double speed = 0.0;                                  ///< of the axle along the ground, m/s
  double turn = 0.0;                                   ///< rad/s
  double pitch = 0.0;       ///< of the body from the vertical, rad, positive forward (REP-103)
  double pitch_rate = 0.0;  ///< rad/s
};

/// Commanded velocities.
struct SegwayCommand {
  double speed = 0.0;  ///< m/s
  double turn = 0.0;   ///< rad/s
};

/// External disturbances.
struct SegwayDisturbance {
  double slope = 0.0;       ///< of the ground ahead, rad, uphill positive
  double pitch_push = 0.0;  ///< rad/s^2
  double turn_push = 0.0;   ///< rad/s^2
};

/// Returns the state at rest on a slope (rad, uphill positive), with the lean of equilibrium.
SegwayState standingSegway(const Eigen::Vector2d& position, double yaw, double slope);

/// Integrates `dt` seconds (at most 0.01). The body is an inverted pendulum of equivalent length L whose pivot the
/// wheels accelerate by a; on a slope the contact point lies in front of the axle by r sin(slope):
///   L pitch'' = g sin(pitch) - a cos(pitch) - g r / l sin(slope)
/// (textbook cart and pole with the axle's acceleration as input; Grasser et al., JOE: a mobile, inverted pendulum,
/// 2002, give the masses). The controller of the base balances: state feedback with both poles at 4 rad/s, damping 0.7,
/// about the lean that accelerates towards the desired speed. The robot therefore leans into every acceleration, and
/// rolls back slightly before it moves forward.
SegwayState stepSegway(const SegwayState& state, const SegwayCommand& command, const SegwayDisturbance& disturbance,
                       double dt);

}  // namespace urban_nav_sim
