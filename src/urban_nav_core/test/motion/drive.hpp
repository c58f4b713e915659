// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/motion/motion_sensors.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace urban_nav_core {

/// Motion of a robot on level ground, with pitch and roll oscillations, at 1 ms. Stamps are nanoseconds since the
/// start.
class LevelDrive {
 public:
  explicit LevelDrive(double seconds) {
    double yaw = 0.0;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (int ms = 0; ms <= static_cast<int>(1000.0 * seconds); ++ms) {
      const double t = 1e-3 * ms;
      const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(0.03 * std::sin(2.3 * t), Eigen::Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(0.02 * std::sin(3.1 * t), Eigen::Vector3d::UnitX());
      poses_.emplace_back(q, p);
      levels_.emplace_back(Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), p);
      const double half = yaw + 0.5e-3 * yawRate(t);
      p += 1e-3 * speed(t) * Eigen::Vector3d(std::cos(half), std::sin(half), 0.0);
      yaw += 1e-3 * yawRate(t);
    }
  }

  static double yawRate(double t) { return 0.5 * std::sin(0.6 * t) + 0.2 * std::sin(1.7 * t); }
  static double speed(double t) { return 1.2 + 0.4 * std::sin(0.9 * t); }

  int milliseconds() const { return static_cast<int>(poses_.size()) - 1; }
  /// Returns T_odom_base.
  const Pose& at(int ms) const { return poses_[static_cast<std::size_t>(ms)]; }
  Pose between(int from, int to) const { return at(from).inverse() * at(to); }
  /// Returns the planar motion of the wheels between two times.
  Pose rolled(int from, int to) const {
    return levels_[static_cast<std::size_t>(from)].inverse() * levels_[static_cast<std::size_t>(to)];
  }

 private:
  std::vector<Pose> poses_, levels_;
};

constexpr StampNs kMillisecond = 1'000'000;

/// Errors of the sensors of a drive.
struct DriveErrors {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();  // rad/s
  double rate_density = 0.0017;                    // rad/s/sqrt(Hz)
  int imu_delay_ms = 0;
  double speed_scale = 1.0, turn_scale = 1.0;
  double wheel_noise = 0.01;  // share of the distance of a message
};

/// Draws sensor and reference measurements of a drive. Deterministic for a seed.
class DriveSensors {
 public:
  DriveSensors(const LevelDrive& drive, const DriveErrors& errors, unsigned seed)
      : drive_(drive), errors_(errors), random_(seed) {}

  /// Returns the rate of a gyroscope over 10 ms from `ms` on.
  MotionInput gyroscope(int ms) {
    constexpr int kPeriod = 10;
    const double seconds = 1e-3 * kPeriod;
    const Eigen::Vector3d turn = logSo3(drive_.between(ms, ms + kPeriod).q()) + seconds * errors_.bias +
                                 errors_.rate_density * std::sqrt(seconds) * noise();
    MotionInput input;
    input.source = MotionSource::Gyroscope;
    input.from = (ms + errors_.imu_delay_ms) * kMillisecond;
    input.to = input.from + kPeriod * kMillisecond;
    input.T_from_to = Pose(expSo3(turn), Eigen::Vector3d::Zero());
    const double sigma = errors_.rate_density * std::sqrt(seconds);
    if (sigma > 0.0) input.information.diagonal().tail<3>().setConstant(1.0 / (sigma * sigma));
    return input;
  }

  /// Returns the wheel measurement over 40 ms from `ms` on.
  MotionInput wheels(int ms) {
    constexpr int kPeriod = 40;
    Vector6d motion = logSe3(drive_.rolled(ms, ms + kPeriod));
    const double sigma = errors_.wheel_noise * motion[0] + 2e-4;
    motion[0] = errors_.speed_scale * motion[0] + sigma * noise().x();
    motion[5] = errors_.turn_scale * motion[5] + sigma * noise().x();
    MotionInput input;
    input.source = MotionSource::Wheels;
    input.from = ms * kMillisecond;
    input.to = input.from + kPeriod * kMillisecond;
    input.T_from_to = expSe3(motion);
    input.information.diagonal() << 1.0 / (sigma * sigma), 1.0 / (sigma * sigma), 0.0, 0.0, 0.0, 1.0 / (sigma * sigma);
    return input;
  }

  /// Returns a step as measured by the reference, with errors according to its covariance, which is all drift.
  MeasuredStep step(std::int64_t frame, int from, int to) {
    constexpr double kForward = 1e-3, kTurn = 1e-4;  // m, rad
    MeasuredStep settled;
    settled.frame = frame;
    settled.stamp = to * kMillisecond;
    settled.q_odom_base = drive_.at(to).q();
    settled.step.from = from * kMillisecond;
    settled.step.to = to * kMillisecond;
    Vector6d error;
    error << kForward * noise(), kTurn * noise();
    settled.step.T_from_to = boxPlus(drive_.between(from, to), error);
    Vector6d variances;
    variances << Eigen::Vector3d::Constant(kForward * kForward), Eigen::Vector3d::Constant(kTurn * kTurn);
    settled.step.covariance = settled.step.drift_covariance = variances.asDiagonal();
    return settled;
  }

  Eigen::Vector3d noise() { return {normal_(random_), normal_(random_), normal_(random_)}; }

 private:
  const LevelDrive& drive_;
  DriveErrors errors_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace urban_nav_core
