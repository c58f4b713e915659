// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/sensors/clock_examination.hpp"
#include "urban_nav_input/sensors/gps_examination.hpp"
#include "urban_nav_input/sensors/laser_examination.hpp"
#include "urban_nav_input/sensors/laser_ground.hpp"
#include "urban_nav_input/sensors/motion_examination.hpp"
#include "urban_nav_input/sensors/reading_examination.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/accelerometer.hpp"

namespace urban_nav_input {

/// Reads the messages of all sensors except the cameras by the conventions of the user, and examines them. Not
/// thread-safe.
class BagSensors {
 public:
  BagSensors(const SourceOptions& options, const BagTopics& topics) : options_(options), topics_(topics) {}

  /// Adds findings that are known before the first message.
  void add(const std::vector<Finding>& findings) {
    findings_.insert(findings_.end(), findings.begin(), findings.end());
  }
  /// Adds the laser of a topic with its mounting.
  void addLaser(const std::string& topic, const std::string& frame, const urban_nav_core::Pose& T_base_laser);
  void placeImu(const urban_nav_core::Matrix3d& R_base_imu) {
    R_base_imu_ = R_base_imu;
    accelerometer_.emplace(R_base_imu, options_.sensors.accelerometer);
  }

  /// Adds an image; stamp and receipt in ns.
  void addImage(const std::string& topic, urban_nav_core::StampNs stamp, urban_nav_core::StampNs receipt) {
    clocks_.add("images", topic, stamp, receipt);
  }
  /// Adds a sweep of a 3D LiDAR; its reference and the receipt of its cloud in ns.
  void addSweep(const std::string& topic, urban_nav_core::StampNs reference, urban_nav_core::StampNs receipt);
  /// Corrects stamp and rates of a message of the IMU, and collects its specific force. Returns whether it can be used.
  bool add(sensor_msgs::Imu& imu, const std::string& topic, urban_nav_core::StampNs receipt);
  /// Corrects stamp and positions of a message of wheel odometry. Returns whether it can be used.
  bool add(nav_msgs::Odometry& wheels, const std::string& topic, urban_nav_core::StampNs receipt);
  void add(const sensor_msgs::NavSatFix& fix, const std::string& topic, urban_nav_core::StampNs receipt);
  /// Returns the scan of a message of the n-th laser; nullopt if the directions of its beams are unknown.
  std::optional<urban_nav_core::PlanarScan> read(std::size_t laser, const sensor_msgs::LaserScan& message,
                                                 urban_nav_core::StampNs receipt);

  /// Returns the specific forces in the axes of base_link; empty for a faulty accelerometer.
  std::vector<urban_nav_core::SpecificForce> forces() const;
  std::vector<Finding> findings() const;
  /// See Source::sightFindings(). `is_camera_placed`: whether the recording has the extrinsics of the camera.
  std::vector<Finding> sightFindings(const Sight& sight, double stereo_scale, bool is_camera_placed) const;
  /// Reads or writes the state between two messages, of the same lasers and the same IMU.
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<Finding> laserGroundFindings(const std::vector<double>& stereo) const;
  std::optional<double> findDelay(const std::string& role) const;

  const SourceOptions& options_;
  const BagTopics& topics_;
  std::vector<Finding> findings_;
  std::optional<urban_nav_ros::Accelerometer> accelerometer_;
  std::vector<urban_nav_core::SpecificForce> forces_;
  std::vector<std::string> laser_topics_;
  std::vector<std::pair<std::string, urban_nav_core::Pose>> laser_places_;  // frame, T_base_laser
  std::array<LaserGround, 2> laser_grounds_, exchanged_grounds_;  // with the mounting of each, and of the other one
  std::vector<LaserExamination> lasers_;                          // as laser_topics_
  ReadingExamination imu_, wheels_;
  GpsExamination gps_;
  ClockExamination clocks_;
  MotionExamination motion_;
  std::optional<urban_nav_core::Matrix3d> R_base_imu_;
};

}  // namespace urban_nav_input
