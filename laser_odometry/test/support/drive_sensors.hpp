// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace laser_odometry {

/// Errors of a gyroscope and of wheels.
struct SensorErrors {
  double speed_scale = 1.0;                        ///< measured over true
  double wheel_noise = 0.02;                       ///< share of the distance of a message
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  ///< rad/s
  double rate_factor = 1.0;                        ///< measured over true rates
  bool has_gyroscope = true, has_wheels = true;
};

/// Gyroscope of 100 Hz and wheels of 25 Hz on a vehicle with a known motion T_world_base(t).
class DriveSensors {
 public:
  DriveSensors(std::function<urban_nav_core::Pose(double)> motion, const SensorErrors& errors, std::uint64_t seed)
      : motion_(std::move(motion)), errors_(errors), dice_(1000 + seed) {}

  /// Returns the inputs since the last call up to a time, s, in order of time.
  std::vector<urban_nav_core::MotionInput> until(double seconds) {
    std::vector<urban_nav_core::MotionInput> inputs;
    for (; kPeriodMs * (tick_ + 1) <= std::lround(1e3 * seconds); ++tick_) {
      if (errors_.has_gyroscope) inputs.push_back(rate(kPeriodMs * tick_));
      if (errors_.has_wheels && tick_ % 4 == 3) inputs.push_back(roll(kPeriodMs * (tick_ - 3)));
    }
    return inputs;
  }

 private:
  static constexpr urban_nav_core::StampNs kMillisecond = 1'000'000;
  static constexpr urban_nav_core::StampNs kBegin = 1'700'000'000'000'000'000;  ///< of SpinningLidar, ns
  static constexpr int kPeriodMs = 10;
  static constexpr double kRateSigma = 5e-3;  // rad/s

  static urban_nav_core::MotionInput input(urban_nav_core::MotionSource source, int from_ms, int to_ms) {
    urban_nav_core::MotionInput input;
    input.source = source;
    input.from = kBegin + from_ms * kMillisecond;
    input.to = kBegin + to_ms * kMillisecond;
    return input;
  }
  urban_nav_core::MotionInput rate(int from_ms) {
    const double seconds = 1e-3 * kPeriodMs, from = 1e-3 * from_ms;
    urban_nav_core::MotionInput result = input(urban_nav_core::MotionSource::Gyroscope, from_ms, from_ms + kPeriodMs);
    const Eigen::Vector3d turn = urban_nav_core::logSo3((motion_(from).inverse() * motion_(from + seconds)).q());
    const Eigen::Vector3d noise(dice_.normal(), dice_.normal(), dice_.normal());
    result.T_from_to = urban_nav_core::Pose(
        urban_nav_core::expSo3(errors_.rate_factor * turn + seconds * (errors_.bias + kRateSigma * noise)),
        Eigen::Vector3d::Zero());
    const double sigma = kRateSigma * seconds;
    result.information.diagonal().tail<3>().setConstant(1.0 / (sigma * sigma));
    return result;
  }
  urban_nav_core::MotionInput roll(int from_ms) {
    const double from = 1e-3 * from_ms, to = from + 4e-3 * kPeriodMs;
    urban_nav_core::MotionInput result = input(urban_nav_core::MotionSource::Wheels, from_ms, from_ms + 4 * kPeriodMs);
    urban_nav_core::Vector6d motion = urban_nav_core::logSe3(motion_(from).inverse() * motion_(to));
    const double sigma = errors_.wheel_noise * std::abs(motion[0]) + 1e-4, turn_sigma = 1e-3;
    motion[0] = errors_.speed_scale * motion[0] + sigma * dice_.normal();
    motion[5] += turn_sigma * dice_.normal();
    for (const int row : {1, 2, 3, 4}) motion[row] = 0.0;
    result.T_from_to = urban_nav_core::expSe3(motion);
    const double along = 1.0 / (sigma * sigma);
    result.information.diagonal() << along, along, 0.0, 0.0, 0.0, 1.0 / (turn_sigma * turn_sigma);
    return result;
  }

  std::function<urban_nav_core::Pose(double)> motion_;
  SensorErrors errors_;
  urban_nav_core::testing::Dice dice_;
  int tick_ = 0;
};

}  // namespace laser_odometry
