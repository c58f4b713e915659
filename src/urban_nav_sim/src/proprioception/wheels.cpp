// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/wheels.hpp"

#include <array>
#include <cmath>

#include "motion/simulate_drive.hpp"
#include "noise/smooth.hpp"

namespace urban_nav_sim {
namespace {

constexpr int kWheelSteps = 9;  // between two measurements: 4 ms, in which speeds are nearly constant
constexpr double kCountsPerMetre = 33215.0, kCountsPerSpeed = 332.0, kCountsPerTurn = 7.8 * 180.0 / M_PI;

struct Rolling {
  double speed = 0.0, turn = 0.0;  // of the axle along the ground, m/s; rad/s
};

Rolling computeRolling(const MotionState& motion_state) {
  const Eigen::Vector3d axle(0.0, 0.0, kWheelRadius);
  const Eigen::Quaterniond& R = motion_state.T_world_base.q();
  const Eigen::Vector3d velocity = motion_state.velocity_world + R * motion_state.rate_base.cross(axle);
  const double forward = velocity.dot(R * Eigen::Vector3d::UnitX());
  return {std::copysign(velocity.norm(), forward), (R * motion_state.rate_base).z()};
}

double stepped(double value, double counts_per_unit) { return std::round(value * counts_per_unit) / counts_per_unit; }

// Left and right wheel.
using Both = std::array<double, 2>;

}  // namespace

WheelOptions perfectWheels() { return {0.0, 0.0, 1.0, 0.0, false, 0.0}; }

Wheels::Wheels(const Motion& motion, const WheelOptions& options, const Clock& clock, const Noise& noise) {
  const Schedule schedule = sensorSchedule(Sensor::Wheels);
  const Noise slip_noise = noise.of("slip");
  const double scale_both = 1.0 + options.scale_sigma * noise.normal(0) +
                            noise.of("scale").uniform(0, -options.largest_scale, options.largest_scale),
               apart = options.difference_sigma * noise.normal(1);
  const Both scale{scale_both - apart, scale_both + apart};
  const auto slipAt = [&](std::size_t wheel, double t) {
    return options.slip_sigma == 0.0 ? 0.0 : options.slip_sigma * smoothNoise(slip_noise.of(wheel), t / 0.5);
  };
  const auto speedsAt = [&](double t) {
    const Rolling rolling = computeRolling(motion.at(t));
    Both speeds;
    for (std::size_t i = 0; i < 2; ++i) {
      const double side = i == 0 ? -0.5 : 0.5;
      speeds[i] = (rolling.speed + side * kTrack * options.track * rolling.turn) * scale[i] * (1.0 + slipAt(i, t));
    }
    return speeds;
  };

  const std::int64_t count = schedule.count(motion.duration());
  all_.reserve(static_cast<std::size_t>(count));
  Both travel{0.0, 0.0}, counted{0.0, 0.0};
  double x = 0.0, y = 0.0, yaw = 0.0, last = 0.0;
  for (std::int64_t k = 0; k < count; ++k) {
    const double t = schedule.at(k), dt = (t - last) / kWheelSteps;
    for (int i = 0; i < kWheelSteps; ++i) {
      const Both speeds = speedsAt(last + (i + 0.5) * dt);
      Both way;
      for (std::size_t w = 0; w < 2; ++w) {
        travel[w] += speeds[w] * dt;
        const double now = options.counts ? stepped(travel[w], kCountsPerMetre) : travel[w];
        way[w] = now - counted[w];
        counted[w] = now;
      }
      const double turned = (way[1] - way[0]) / kTrack, forward = 0.5 * (way[0] + way[1]);
      x += forward * std::cos(yaw + 0.5 * turned);
      y += forward * std::sin(yaw + 0.5 * turned);
      yaw += turned;
    }
    const Both speeds = speedsAt(t);
    WheelMeasurement measured;
    measured.stamp = clock.stamp(k, t);
    measured.T_odom_base = urban_nav_core::Pose(urban_nav_core::expSo3({0.0, 0.0, yaw}), {x, y, 0.0});
    measured.speed = 0.5 * (speeds[0] + speeds[1]);
    measured.yaw_rate = (speeds[1] - speeds[0]) / kTrack;
    if (options.counts) {
      measured.speed = stepped(measured.speed, kCountsPerSpeed);
      measured.yaw_rate = stepped(measured.yaw_rate, kCountsPerTurn);
    }
    errors_.push_back({scale[0], scale[1], slipAt(0, t), slipAt(1, t)});
    all_.push_back(measured);
    last = t;
  }
}

}  // namespace urban_nav_sim
