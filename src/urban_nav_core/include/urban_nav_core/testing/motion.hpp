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

/// The optical frame of a camera at `position` that looks along `yaw` (rad, from world x to y), then pitched down and
/// rolled to the right.
Pose lookingAlong(const Vector3d& position, double yaw, double pitch = 0.0, double roll = 0.0);

Motion standing(const Pose& T_world_camera);
/// Stands until `start_s`, then goes on at `speed` (m/s) straight along the optical axis; the speed rises smoothly
/// over `ramp_s`.
Motion straight(const Pose& T_world_camera, double speed, double start_s = 0.0, double ramp_s = 0.0);
/// An ellipse about the origin with half axes a, b (m), left about, heading along the path, `round_s` seconds a
/// round; sways by some centimetres and degrees like a robot on uneven ground.
Motion loop(double a, double b, double height, double round_s);
/// Turns left in `turns` equal parts through 360 deg, `turn_s` each, with a stop of `stop_s` after each; the camera
/// sits `lever` metres ahead of the axis at `position`.
Motion turnsWithStops(const Vector3d& position, int turns, double turn_s, double stop_s, double lever);
/// Turns left about the vertical at `rate` (rad/s), reached smoothly within `ramp_s`; the camera sits `lever` metres
/// ahead of the axis.
Motion spin(const Vector3d& position, double rate, double ramp_s, double lever);
/// Random and smooth in all six degrees of freedom: sums of slow sines, within `reach` (m) of `position` and `angle`
/// (rad) of looking along +x in pitch and roll; heading swings through `yaw` (rad) to either side.
Motion wander(const Vector3d& position, const Vector3d& reach, double yaw, double angle, std::uint32_t seed);
/// A camera in a hand that shakes: sines of about `hz` in all six degrees of freedom, `reach` (m) and `angle` (rad) to
/// either side of looking along +x at `position`.
Motion shake(const Vector3d& position, double reach, double angle, double hz);
/// Along a street in +x at `speed` (m/s), swaying and pitching a little as a car does.
Motion drive(double speed, double height);

/// Speed of the motion "straight" in the street, m/s.
constexpr double kDriveSpeed = 8.0;

/// The names that namedMotion knows, for --help.
std::vector<std::string> motionNames();
/// A motion that suits the scene "room" or "street", by its name. Throws UserError with the names allowed.
Motion namedMotion(const std::string& name, const std::string& scene, std::uint32_t seed);

}  // namespace urban_nav_core::testing
