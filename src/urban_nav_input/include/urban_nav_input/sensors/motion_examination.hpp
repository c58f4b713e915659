// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/sensors/sight.hpp"
#include "urban_nav_ros/sensor_corrections.hpp"

namespace urban_nav_input {

/// Compares the motion measured by wheels and a gyroscope with each other and with stereo: scale and sign of distances
/// and rotations, and the delay of their stamps. Needs sufficient motion for a ratio. Not thread-safe.
class MotionExamination {
 public:
  /// Adds the pose by wheels, m and rad in their odometry frame, and the forward speed, m/s.
  void addWheels(urban_nav_core::StampNs stamp, const std::array<double, 3>& x_y_yaw, double speed);
  /// Adds the rate about the vertical axis of base_link, rad/s.
  void addGyroscope(urban_nav_core::StampNs stamp, double yaw_rate);
  /// `seen`: some motions of the recording, in any order. `wheels`, `imu`: names of the topics.
  std::vector<Finding> findings(const std::vector<SeenMotion>& seen, const std::string& wheels, const std::string& imu,
                                const urban_nav_ros::SensorCorrections& present) const;
  void archive(urban_nav_core::Archive& archive) {
    archive(wheel_stamps_, wheels_, speed_stamp_, speed_, by_speed_, gyroscope_stamps_, gyroscope_, last_pose_,
            last_rate_);
  }

 private:
  using Pairs = std::vector<std::pair<double, double>>;
  /// Measured motions with the reference of the same intervals.
  struct Ratios {
    Pairs distances, wheel_turns, gyroscope_turns;  ///< by stereo
    Pairs gyroscope_wheels;                         ///< rotations of the gyroscope relative to those of the wheels
  };
  Ratios compare(const std::vector<SeenMotion>& seen) const;
  std::optional<Finding> distanceFinding(const Ratios& ratios, const std::string& wheels,
                                         const urban_nav_ros::SensorCorrections& present) const;
  static std::optional<Finding> turnFinding(const Ratios& ratios, bool are_wheels_sound, const std::string& imu,
                                            const urban_nav_ros::SensorCorrections& present);
  std::optional<Finding> delayFinding(const std::vector<SeenMotion>& seen, const std::string& wheels,
                                      const std::string& imu, const urban_nav_ros::SensorCorrections& present) const;

  std::vector<urban_nav_core::StampNs> wheel_stamps_, gyroscope_stamps_;
  std::vector<std::array<double, 2>> wheels_;  // signed distance, m; heading without jumps, rad; both since the start
  std::vector<double> gyroscope_;              // integrated heading, rad
  std::array<double, 3> last_pose_ = {{}};
  double last_rate_ = 0.0;
  urban_nav_core::StampNs speed_stamp_ = 0;
  double speed_ = 0.0, by_speed_ = 0.0;  // m/s, of the last message; m: distance by speeds
};

}  // namespace urban_nav_input
