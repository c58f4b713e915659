// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "urban_nav_sim/session.hpp"

/// What of urban_nav_sim knows of ROS: the bag of the command and the live node get their messages here, so that equal
/// sessions are equal bytes in both.
namespace urban_nav_sim {

/// A message (never null) and the topic of docs/architecture.md where it belongs, without a slash in front: a name
/// space may come there.
struct TopicMessage {
  using Message = std::variant<sensor_msgs::ImagePtr, sensor_msgs::CameraInfoPtr, sensor_msgs::CompressedImagePtr,
                               sensor_msgs::LaserScanPtr, sensor_msgs::ImuPtr, sensor_msgs::MagneticFieldPtr,
                               nav_msgs::OdometryPtr, sensor_msgs::NavSatFixPtr, sensor_msgs::PointCloud2Ptr,
                               geometry_msgs::TwistStampedPtr, geometry_msgs::PoseStampedPtr>;
  std::string topic;
  Message message;
};

/// Every topic on which these sensors, and the truth, may speak, with an empty message of its type.
std::vector<TopicMessage> listTopics(const std::set<Sensor>& sensors);

/// Measurements of one session as messages. Not thread-safe: laser scans are counted.
class MeasurementMessages {
 public:
  explicit MeasurementMessages(const Session& session);

  /// In the order in which they are to be published; none where nothing was measured.
  std::vector<TopicMessage> convert(const Measurement& measurement);

 private:
  using Messages = std::vector<TopicMessage>;
  Messages from(const StereoMeasurement& pair) const;
  Messages from(const LadybugMeasurement& panorama) const;
  Messages from(const LaserMeasurement& turn);
  Messages from(const ImuMeasurement& imu) const;
  Messages from(const WheelMeasurement& wheels) const;
  Messages from(const GpsMeasurement& gps) const;
  Messages from(const LidarMeasurement& lidar) const;
  Messages from(const TruthMeasurement& truth) const;
  Messages from(const ViewTruth&) const { return {}; }  ///< for the truth folder alone

  sensor_msgs::CameraInfo left_, right_;
  std::array<sensor_msgs::CameraInfo, 5> ladybug_;
  std::array<std::uint32_t, 2> turns_{};
};

/// Where the sensors sit, for /tf_static, of the stamp at which the session begins.
std::vector<geometry_msgs::TransformStamped> staticTransforms(const Session& session);

}  // namespace urban_nav_sim
