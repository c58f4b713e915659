// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

constexpr double kHeight = 1.1;  // m, of the camera above the floor

/// Smooth step: 0 before 0, 1 after 1, with two continuous derivatives.
double smoothStep(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

/// Returns the distance after `t` at a speed that rises smoothly from 0 to 1 over `ramp`.
double coveredAfter(double t, double ramp) {
  if (t <= 0.0) return 0.0;
  if (ramp <= 0.0 || t >= ramp) return t - 0.5 * std::max(0.0, ramp);
  const double s = t / ramp;
  return ramp * s * s * s * s * (2.5 + s * (s - 3.0));  // the integral of smoothStep
}

}  // namespace

Pose lookingAlong(const Vector3d& position, double yaw, double pitch, double roll) {
  Matrix3d R_body_optical;  // body: x forward, y left, z up
  R_body_optical << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  const Quaterniond q =
      expSo3(Vector3d(0.0, 0.0, yaw)) * expSo3(Vector3d(0.0, pitch, 0.0)) * expSo3(Vector3d(roll, 0.0, 0.0));
  return Pose(q * Quaterniond(R_body_optical), position);
}

Motion standing(const Pose& T_world_camera) {
  return [T_world_camera](double) { return T_world_camera; };
}

Motion straight(const Pose& T_world_camera, double speed, double start_s, double ramp_s) {
  return [=](double t) {
    return T_world_camera *
           Pose(Quaterniond::Identity(), Vector3d(0.0, 0.0, speed * coveredAfter(t - start_s, ramp_s)));
  };
}

Motion loop(double a, double b, double height, double round_s) {
  return [=](double t) {
    const double theta = 2.0 * M_PI * t / round_s;
    const Vector3d position(a * std::sin(theta), -b * std::cos(theta), height + 0.015 * std::sin(5.3 * theta));
    // atan2 is discontinuous at +-pi, but the quaternion is not.
    const double yaw = std::atan2(b * std::sin(theta), a * std::cos(theta));
    return lookingAlong(position, yaw, 0.02 * std::sin(7.1 * theta),
                        0.02 * std::sin(4.7 * theta + 1.0) - 0.02 * std::sin(1.0));
  };
}

Motion turnsWithStops(const Vector3d& position, int turns, double turn_s, double stop_s, double lever) {
  return [=](double t) {
    const double cycle = turn_s + stop_s;
    const double done = std::floor(t / cycle);
    const double yaw = 2.0 * M_PI / turns * (done + smoothStep((t - done * cycle) / turn_s));
    return lookingAlong(position + lever * Vector3d(std::cos(yaw), std::sin(yaw), 0.0), yaw);
  };
}

Motion spin(const Vector3d& position, double rate, double ramp_s, double lever) {
  return [=](double t) {
    const double yaw = rate * coveredAfter(t, ramp_s);
    return lookingAlong(position + lever * Vector3d(std::cos(yaw), std::sin(yaw), 0.0), yaw);
  };
}

Motion wander(const Vector3d& position, const Vector3d& reach, double yaw, double angle, std::uint32_t seed) {
  // Three sines each, with periods between 4 and 30 s and amplitudes that add up to the reach.
  struct Wave {
    double amplitude, rate, phase;
  };
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  std::array<std::array<Wave, 3>, 6> waves{};
  const std::array<double, 6> reaches{reach.x(), reach.y(), reach.z(), yaw, angle, angle};
  const std::array<double, 3> shares{0.6, 0.28, 0.12}, periods{22.0, 10.0, 5.0};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      waves[i][k] = {reaches[i] * shares[k], 2.0 * M_PI / (periods[k] * between(0.8, 1.3)), between(0.0, 2.0 * M_PI)};
    }
  }
  return [=](double t) {
    std::array<double, 6> x{};
    for (std::size_t i = 0; i < 6; ++i) {
      for (const Wave& wave : waves[i]) x[i] += wave.amplitude * std::sin(wave.rate * t + wave.phase);
    }
    return lookingAlong(position + Vector3d(x[0], x[1], x[2]), x[3], x[4], x[5]);
  };
}

Motion shake(const Vector3d& position, double reach, double angle, double hz) {
  return [=](double t) {
    const auto wave = [&](double factor, double phase) { return std::sin(2.0 * M_PI * hz * factor * t + phase); };
    const Vector3d offset(wave(0.83, 0.3), wave(1.0, 1.9), 0.5 * wave(1.21, 4.0));
    return lookingAlong(position + reach * offset, angle * wave(1.07, 0.0), 0.5 * angle * wave(0.91, 2.2),
                        0.3 * angle * wave(1.33, 5.1));
  };
}

Motion drive(double speed, double height) {
  return [=](double t) {
    const double x = speed * t;
    const Vector3d position(x, 0.35 * (std::cos(x / 11.0) - 1.0), height + 0.01 * std::sin(x / 1.9));
    return lookingAlong(position, -0.35 / 11.0 * std::sin(x / 11.0), 0.006 * std::sin(x / 2.3),
                        0.006 * std::sin(x / 3.1));
  };
}

std::vector<std::string> motionNames() { return {"stand", "straight", "creep", "loop", "turns", "spin", "wander"}; }

Motion namedMotion(const std::string& name, const std::string& scene, std::uint32_t seed) {
  const bool in_room = scene == "room";
  const RoomSize room;
  const Pose start =
      in_room ? lookingAlong({-room.freeX(), 0.3, kHeight}, 0.0) : lookingAlong({0.0, 0.0, kHeight + 0.5}, 0.0);
  const Vector3d middle = in_room ? Vector3d(0.0, 0.0, kHeight) : Vector3d(20.0, 0.0, kHeight + 0.5);
  if (name == "stand") return standing(start);
  if (name == "straight") return in_room ? straight(start, 0.5, 0.0, 0.5) : drive(kDriveSpeed, kHeight + 0.5);
  if (name == "creep") return straight(start, 0.02, 1.0, 0.2);
  if (name == "loop")
    return loop(in_room ? 0.75 * room.freeX() : 15.0, in_room ? 0.75 * room.freeY() : 2.0, kHeight, 24.0);
  if (name == "turns") return turnsWithStops(middle, 8, 1.5, 0.75, 0.3);
  if (name == "spin") return spin(middle, M_PI / 3.0, 1.0, 0.2);
  if (name == "wander") return wander(middle, {0.7 * room.freeX(), 0.7 * room.freeY(), 0.15}, 1.2, 0.08, seed);
  std::string allowed;
  for (const std::string& known : motionNames()) allowed += (allowed.empty() ? "" : ", ") + known;
  throw UserError("--motion", name, allowed);
}

}  // namespace urban_nav_core::testing
