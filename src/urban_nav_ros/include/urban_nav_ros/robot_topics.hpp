// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <set>
#include <string>
#include <type_traits>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stereo_topics.hpp"
#include "urban_nav_ros/turn_message.hpp"

namespace urban_nav_ros {

/// Topic groups of a stage that processes a robot with odometry (urban_nav_live::TopicMonitor).
namespace topic_groups {
constexpr const char* kOdometry = "odometry";
constexpr const char* kImages = "images";
constexpr const char* kLasers = "lasers";
}  // namespace topic_groups

/// s without a message after which a topic is silent. The first smoothed pose of a filter with a window takes that
/// long.
constexpr double kRobotTopicTimeout = 5.0;

/// Subscribes to the turns of the right camera that odometry finds. Requires that Input can be made from
/// urban_nav_core::StampedTurn.
template <typename Input>
void subscribeTurns(StageNodeWith<Input>& node, int queue) {
  TopicOptions options;
  options.queue = queue;
  options.is_monitored = options.is_paused = false;
  node.template subscribeInput<urban_nav_msgs::VoStatistics>(
      topics::kVoStatistics, options,
      [](const urban_nav_msgs::VoStatisticsConstPtr& message) { return toStampedTurn(*message); });
}

/// Subscribes to both poses of odometry, to /tf_static, to the stereo camera and turns of its right camera if `stereo`,
/// and to both lasers, a further one (`scan`) and the 3D LiDAR if `lasers`. Requires that Input is constructible from
/// ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, sensor_msgs::LaserScanConstPtr, urban_nav_core::StampedPose
/// (filtered) and urban_nav_core::SessionStep (smoothed); without sensor_msgs::PointCloud2ConstPtr, the LiDAR is left
/// out. Odometry is also received during a pause, so that it has no gap.
template <typename Input>
void subscribeRobot(StageNodeWith<Input>& node, int queue, bool stereo, bool compressed, bool lasers) {
  TopicOptions options;
  options.timeout = kRobotTopicTimeout;
  options.queue = queue;
  options.group = topic_groups::kImages;
  if (stereo) {
    subscribeStereo(node, options, compressed, urban_nav_core::MotionChoice());
    if constexpr (std::is_constructible_v<Input, urban_nav_core::StampedTurn>) subscribeTurns(node, queue);
  } else {
    TopicOptions unmonitored;
    unmonitored.is_monitored = unmonitored.is_paused = false;
    node.template subscribeInput<tf2_msgs::TFMessage>(
        topics::kStaticTransforms, unmonitored,
        [](const tf2_msgs::TFMessageConstPtr& message) { return Input(message); });
  }
  options.group = topic_groups::kLasers;
  std::set<std::string> scans;  // one topic may be connected to two names
  for (const char* topic : {topics::kLaserLeft, topics::kLaserRight, topics::kScan}) {
    if (!lasers || !scans.insert(node.nh().resolveName(topic)).second) continue;
    TopicOptions of_laser = options;
    of_laser.is_monitored = options.is_monitored && std::string(topic) != topics::kScan;  // the robot may have none
    node.template subscribeInput<sensor_msgs::LaserScan>(
        topic, of_laser, [](const sensor_msgs::LaserScanConstPtr& message) { return Input(message); });
  }
  if constexpr (std::is_constructible_v<Input, sensor_msgs::PointCloud2ConstPtr>) {
    TopicOptions unmonitored = options;
    unmonitored.is_monitored = false;  // the robot may have none
    if (lasers)
      node.template subscribeInput<sensor_msgs::PointCloud2>(
          topics::kPoints, unmonitored, [](const sensor_msgs::PointCloud2ConstPtr& message) { return Input(message); });
  }
  options.group = topic_groups::kOdometry;
  options.is_paused = false;
  node.template subscribeInput<nav_msgs::Odometry>(
      topics::kOdometry, options,
      [](const nav_msgs::OdometryConstPtr& message) -> std::optional<urban_nav_core::StampedPose> {
        const auto T_odom_base = toPose(message->pose.pose);
        if (!T_odom_base) return std::nullopt;
        return urban_nav_core::StampedPose{toStampNs(message->header.stamp), *T_odom_base};
      });
  options.is_awaited = true;
  node.template subscribeInput<urban_nav_msgs::RelativePose>(
      topics::kRelativePose, options,
      [](const urban_nav_msgs::RelativePoseConstPtr& message) { return toSessionStep(*message); });
}

}  // namespace urban_nav_ros
