// SPDX-License-Identifier: BSD-3-Clause
#include "motion/segway.hpp"

#include <algorithm>
#include <cmath>

#include "motion/simulate_drive.hpp"

namespace urban_nav_sim {
namespace {

constexpr double kFallAcceleration = 9.81;  // m/s^2
constexpr double kLength = 0.85;            // m: equivalent length of the pendulum (computers, batteries and mast)
constexpr double kMass = 0.60;              // m: height of the centre of mass above the axle
constexpr double kPole = 4.0, kDamping = 0.7;
constexpr double kStiffness = kFallAcceleration + kPole * kPole * kLength;  // m/s^2 per rad
constexpr double kBrake = 2.0 * kDamping * kPole * kLength;                 // m/s^2 per rad/s
constexpr double kSpeedGain = 1.1;                                          // 1/s: acceleration per error of speed
constexpr double kMostTilt = 0.09;                                          // rad: 0.9 m/s^2
constexpr double kTurnLag = 0.18;                                           // s
constexpr double kMostTurnChange = 3.0;                                     // rad/s^2

// Offset of the contact point in front of the axle on a slope, as the sine of the lean that puts the mass above it.
double wheelOffset(double slope) { return kWheelRadius / kMass * std::sin(slope); }

}  // namespace

SegwayState standingSegway(const Eigen::Vector2d& position, double yaw, double slope) {
  SegwayState state;
  state.position = position;
  state.yaw = yaw;
  state.pitch = std::asin(wheelOffset(slope));
  return state;
}

SegwayState stepSegway(const SegwayState& state, const SegwayCommand& command, const SegwayDisturbance& disturbance,
                       double dt) {
  // The lean that maintains the acceleration; the stiffness must first overcome gravity.
  const double wanted =
      kSpeedGain * (command.speed - state.speed) / kFallAcceleration * (kStiffness - kFallAcceleration) / kStiffness;
  const double foot = wheelOffset(disturbance.slope);
  const double lean = std::clamp(wanted, -kMostTilt, kMostTilt) + foot;
  const double acceleration = kStiffness * (state.pitch - lean) + kBrake * state.pitch_rate;
  const double fall = kFallAcceleration * (std::sin(state.pitch) - foot) - acceleration * std::cos(state.pitch);

  SegwayState next = state;
  next.pitch_rate += dt * (fall / kLength + disturbance.pitch_push);
  next.pitch += dt * next.pitch_rate;
  next.speed += dt * acceleration;
  const double turn_change = std::clamp((command.turn - state.turn) / kTurnLag, -kMostTurnChange, kMostTurnChange);
  next.turn += dt * (turn_change + disturbance.turn_push);
  next.yaw += dt * next.turn;
  const double heading = 0.5 * (state.yaw + next.yaw);
  const double forward = dt * 0.5 * (state.speed + next.speed) * std::cos(disturbance.slope);
  next.position += forward * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  return next;
}

}  // namespace urban_nav_sim
