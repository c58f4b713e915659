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

/// The ROS messages of urban_nav_sim, for both the bag of the command and the live node, so that equal sessions give
/// equal bytes in both.
namespace urban_nav_sim {

/// A message (never null) and its topic of docs/architecture.md, without a leading slash, so that a namespace can be
/// prepended.
struct TopicMessage {
  using Message = std::variant<sensor_msgs::ImagePtr, sensor_msgs::CameraInfoPtr, sensor_msgs::CompressedImagePtr,
                               sensor_msgs::LaserScanPtr, sensor_msgs::ImuPtr, sensor_msgs::MagneticFieldPtr,
                               nav_msgs::OdometryPtr, sensor_msgs::NavSatFixPtr, sensor_msgs::PointCloud2Ptr,
                               geometry_msgs::TwistStampedPtr, geometry_msgs::PoseStampedPtr>;
  std::string topic;
  Message message;
};

/// Returns all topics of these sensors and the truth, with an empty message of their type.
std::vector<TopicMessage> listTopics(const std::set<Sensor>& sensors);

/// Converts the measurements of one session to messages. Not thread-safe, since laser scans are counted.
class MeasurementMessages {
 public:
  explicit MeasurementMessages(const Session& session);

  /// Returns messages in the order of publication; none without a measurement.
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
  Messages from(const ViewTruth&) const { return {}; }  ///< only for the truth folder

  sensor_msgs::CameraInfo left_, right_;
  std::array<sensor_msgs::CameraInfo, 5> ladybug_;
  std::array<std::uint32_t, 2> turns_{};
};

/// Returns the extrinsics for /tf_static, with the stamp of the begin of the session.
std::vector<geometry_msgs::TransformStamped> staticTransforms(const Session& session);

}  // namespace urban_nav_sim
