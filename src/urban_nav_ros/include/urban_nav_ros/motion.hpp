// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <optional>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace urban_nav_ros {

/// Wheel odometry as a motion input: planar motion of base_link between consecutive messages. Forward, lateral and
/// heading components are observed; height, roll and pitch have zero information, independently of the message. Returns
/// nothing for a message that is not later than the previous one or has an invalid pose.
class WheelMotion {
 public:
  /// `noise`: standard deviation of an increment relative to its distance (m) or angle (rad), in addition to 1 mm and 1
  /// mrad.
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

/// Gyroscope as a motion input: rotation of base_link between consecutive messages, at the mean of the two rates.
/// Translation has zero information. Returns nothing for a message that is not later than the previous one or whose
/// rates are not finite.
class GyroMotion {
 public:
  /// `noise`: standard deviation of one rate without its bias, rad/s; 0: that of the messages' covariances, and no
  /// information if they state none. `R_base_imu`: rotation of the device in base_link.
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
