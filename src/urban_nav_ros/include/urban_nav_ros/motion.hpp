// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <optional>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace urban_nav_ros {

/// Wheel odometry as a motion input: from message to message, how base_link moved on the ground. Observed are forward,
/// sideways and heading; height, roll and pitch have zero information, whatever the message says of them. A message
/// that is not later than the one before, or whose pose is none, gives nothing.
class WheelMotion {
 public:
  /// Standard deviation of an increment: `noise` times the distance (m) or the angle (rad), and 1 mm and 1 mrad
  /// beneath.
  explicit WheelMotion(double noise) : noise_(noise) {}
  std::optional<urban_nav_core::MotionInput> add(const nav_msgs::Odometry& message);
  void archive(urban_nav_core::Archive& archive) { archive(last_); }

 private:
  struct Last {
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::Pose T_odom_base = urban_nav_core::Pose();
    void archive(urban_nav_core::Archive& archive) { archive(stamp, T_odom_base); }
  };
  double noise_;
  std::optional<Last> last_;
};

/// A gyroscope as a motion input: the rotation of base_link from message to message, at the mean of the two rates.
/// Translation has zero information. A message that is not later than the one before, or has no finite rates, gives
/// nothing.
class GyroMotion {
 public:
  /// `noise`: standard deviation of one rate, its bias apart, rad/s; 0: as the messages' covariances state, and no
  /// information where they state none. `R_base_imu`: rotation of the device in base_link.
  GyroMotion(double noise, const urban_nav_core::Matrix3d& R_base_imu) : noise_(noise), R_base_imu_(R_base_imu) {}
  std::optional<urban_nav_core::MotionInput> add(const sensor_msgs::Imu& message);
  void archive(urban_nav_core::Archive& archive) { archive(last_); }

 private:
  struct Last {
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::Vector3d rate = urban_nav_core::Vector3d::Zero();
    void archive(urban_nav_core::Archive& archive) { archive(stamp, rate); }
  };
  double noise_;
  urban_nav_core::Matrix3d R_base_imu_;
  std::optional<Last> last_;
};

}  // namespace urban_nav_ros
