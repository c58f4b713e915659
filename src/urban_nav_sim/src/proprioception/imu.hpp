// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "motion/motion.hpp"
#include "proprioception/clock.hpp"
#include "proprioception/random_walk.hpp"
#include "proprioception/schedule.hpp"

namespace urban_nav_sim {

constexpr double kGravity = 9.81;  ///< m/s^2, along -z of `world`

/// Mistakes of a driver; the measurements themselves are correct.
struct ImuMistakes {
  bool exchanges_axes = false;   ///< exchanges x and y
  bool uses_degrees = false;     ///< rates in deg/s
  bool is_ned = false;           ///< axes forward, right, down
  bool removes_gravity = false;  ///< reports accelerations instead of specific forces
};

/// Errors of an XSens MTi (data sheet). All zero: the measurement is exact. Rates and forces are M x true + bias +
/// noise, each with a constant matrix M.
struct ImuOptions {
  double rate_density = 0.1 * M_PI / 180.0;                ///< rad/s/sqrt(Hz)
  double rate_bias = 0.2 * M_PI / 180.0;                   ///< rad/s, initial standard deviation
  double rate_walk = 20.0 / 3600.0 * M_PI / 180.0 / 60.0;  ///< rad/s/sqrt(s): 20 deg/h after an hour
  double force_density = 1e-3;                             ///< m/s^2/sqrt(Hz)
  double force_bias = 0.02;                                ///< m/s^2, standard deviation of the drifting bias
  double force_bias_time = 600.0;                          ///< s, time constant of that drift
  double rate_offset = 0.0;         ///< rad/s, largest constant bias of an axis, added to rate_bias
  double force_offset = 0.0;        ///< m/s^2, largest constant bias of an axis, added to force_bias
  double scale_sigma = 0.0;         ///< scale error of each axis, constant
  double axes_sigma = 0.0;          ///< rad, misalignment of each axis towards each other one, constant
  double field_sigma = 5e-8;        ///< T, noise of one measurement
  double field_bias = 1e-6;         ///< T, of the iron of the robot
  double field_disturbance = 3e-6;  ///< T, of iron in walls and ground, correlated over about 5 m
  ImuMistakes mistakes;
};
ImuOptions perfectImu();

/// The earth's field at Oxford: 48.6 uT, 66.5 deg below the horizon, declination 2.5 deg west; `world` is x east, y
/// north.
Eigen::Vector3d earthField();

/// An XSens on the robot. Immutable, so thread-safe; the motion must outlive it.
class Imu {
 public:
  Imu(const Motion& motion, const urban_nav_core::Pose& T_base_imu, const ImuOptions& options, const Clock& clock,
      const Noise& noise);

  /// Measurement k = 0, 1, ..., taken at sensorSchedule(Sensor::Imu).at(k), in the axes of imu_link.
  ImuMeasurement at(std::int64_t k) const;
  /// Biases at a time of the session in the axes of imu_link: rad/s, m/s^2.
  Eigen::Vector3d rateBias(double t) const { return rate_bias_.at(t) + rate_offset_; }
  Eigen::Vector3d forceBias(double t) const { return force_bias_.at(t) + force_offset_; }
  /// Matrices M of scale and axis errors of gyroscope and accelerometer.
  const Eigen::Matrix3d& rateMatrix() const { return rate_matrix_; }
  const Eigen::Matrix3d& forceMatrix() const { return force_matrix_; }
  /// Returns the exact measurement at any time of the motion, without stamp.
  ImuMeasurement truth(double t) const;

 private:
  void applyMistakes(double t, ImuMeasurement& measured) const;

  const Motion& motion_;
  urban_nav_core::Pose T_base_imu_;
  ImuOptions options_;
  Clock clock_;
  Schedule schedule_ = sensorSchedule(Sensor::Imu);
  Noise rate_noise_, force_noise_, field_noise_;
  RandomWalk rate_bias_, force_bias_;
  Eigen::Vector3d field_bias_, rate_offset_, force_offset_;
  Eigen::Matrix3d rate_matrix_, force_matrix_;
};

}  // namespace urban_nav_sim
