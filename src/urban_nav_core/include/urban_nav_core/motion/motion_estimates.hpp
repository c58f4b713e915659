// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

class Archive;

/// A motion sensor that contradicts the reference, odometry by images or sweeps, and is excluded.
struct MotionSensorFault {
  bool is_wheels = false;        ///< true: wheels; false: gyroscope of the IMU
  bool is_named = false;         ///< the sentence names the cause; false: it states the difference only
  StampNs since = 0, until = 0;  ///< `until` 0: until the end of the session
  std::string sentence;          ///< the fault with a figure, and the remedy
};

/// Returns "wheels not used from 3.2 s on: " and the sentence. `begin`: stamp of the first frame.
std::string describe(const MotionSensorFault& fault, StampNs begin);

/// Newest settled step of the reference compared with motion sensors, after the estimated corrections. A sigma of 0:
/// not compared.
struct MotionComparison {
  Vector3d turn = Vector3d::Zero();        ///< by the reference, rad
  Vector3d turn_error = Vector3d::Zero();  ///< reference minus gyroscope, rad
  double turn_sigma = 0.0;                 ///< each axis, rad
  double forward = 0.0, sideways = 0.0;    ///< motion by the reference, m in base_link
  double forward_error = 0.0;  ///< reference minus wheels as they state it (without the estimated scale), along x, m
  double forward_sigma = 0.0;  ///< m
};

/// Motion sensors and their calibration estimated from the reference. Until the first measurement, estimates and
/// standard deviations are those of the priors. Undefined for a sensor that is absent or excluded.
struct MotionEstimates {
  bool has_gyroscope = false, uses_gyroscope = false, gyroscope_left_out = false;
  bool has_wheels = false, uses_wheels = false, wheels_left_out = false;
  Vector3d gyroscope_bias = Vector3d::Zero();  ///< measured minus true, rad/s, in IMU axes
  Vector3d gyroscope_bias_sigma = Vector3d::Zero();
  double imu_offset_s = 0.0, imu_offset_sigma_s = 0.0;          ///< delay of its stamps relative to the reference clock
  double wheel_scale = 1.0, wheel_scale_sigma = 0.0;            ///< measured over true speed
  double wheel_turn_scale = 1.0, wheel_turn_scale_sigma = 0.0;  ///< measured over true yaw rate
  double wheel_offset_s = 0.0, wheel_offset_sigma_s = 0.0;      ///< as imu_offset_s
  MotionComparison newest;
  std::vector<MotionSensorFault> faults;  ///< ordered by `since`
};

/// Returns the sentence of the latest fault for which the gyroscope or the wheels are excluded; empty: not excluded.
std::string currentFault(const MotionEstimates& motion, bool is_wheels);

/// Serialisation, without `newest` (urban_nav_core/io/archive.hpp).
void archive(Archive& archive, MotionSensorFault& fault);
void archive(Archive& archive, MotionEstimates& motion);

/// Twist of base_link in its own axes: m/s, then rad/s.
struct BodyTwist {
  Vector6d twist = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Identity();
};

}  // namespace urban_nav_core
