// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core::testing {

/// T_world_camera (optical axes: z forward, x right, y down) at a time in seconds, t >= 0. Exact and smooth.
using Motion = std::function<Pose(double t)>;

/// Returns the optical frame of a camera at `position` with heading `yaw` (rad, from world x to y), then pitched down
/// and rolled to the right.
Pose lookingAlong(const Vector3d& position, double yaw, double pitch = 0.0, double roll = 0.0);

Motion standing(const Pose& T_world_camera);
/// Stands until `start_s`, then drives straight along the optical axis at `speed` (m/s), reached smoothly within
/// `ramp_s`.
Motion straight(const Pose& T_world_camera, double speed, double start_s = 0.0, double ramp_s = 0.0);
/// Ellipse about the origin with half axes a, b (m), counter-clockwise, heading along the path, `round_s` seconds per
/// revolution; sways by some centimetres and degrees like a robot on uneven ground.
Motion loop(double a, double b, double height, double round_s);
/// Turns left through 360 deg in `turns` equal parts of `turn_s` each, with a stop of `stop_s` after each; the camera
/// is `lever` metres ahead of the axis at `position`.
Motion turnsWithStops(const Vector3d& position, int turns, double turn_s, double stop_s, double lever);
/// Turns left about the vertical at `rate` (rad/s), reached smoothly within `ramp_s`; the camera is `lever` metres
/// ahead of the axis.
Motion spin(const Vector3d& position, double rate, double ramp_s, double lever);
/// Random smooth motion in all six degrees of freedom: sums of slow sines, within `reach` (m) of `position` and `angle`
/// (rad) of the +x direction in pitch and roll; the heading swings by `yaw` (rad) to either side.
Motion wander(const Vector3d& position, const Vector3d& reach, double yaw, double angle, std::uint32_t seed);
/// Shaking hand-held camera: sines of about `hz` in all six degrees of freedom, with amplitudes `reach` (m) and `angle`
/// (rad) about the +x direction at `position`.
Motion shake(const Vector3d& position, double reach, double angle, double hz);
/// Along a street in +x at `speed` (m/s), with the small sway and pitch of a car.
Motion drive(double speed, double height);

/// Speed of the motion "straight" in the street, m/s.
constexpr double kDriveSpeed = 8.0;

/// Returns the names of namedMotion(), for --help.
std::vector<std::string> motionNames();
/// Returns a motion for the scene "room" or "street" by its name. Throws UserError with the valid names.
Motion namedMotion(const std::string& name, const std::string& scene, std::uint32_t seed);

}  // namespace urban_nav_core::testing
