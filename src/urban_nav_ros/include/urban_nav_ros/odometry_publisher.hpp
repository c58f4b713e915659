// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>
#include <utility>

#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_ros/pose.hpp"

namespace urban_nav_ros {

/// Publishes poses of a robot as nav_msgs/Odometry and on /tf. Used by one thread.
class OdometryPublisher {
 public:
  /// Source of a pose: a measurement of the odometry's sensor, or a propagation between two of them.
  enum class Source { Frame, Propagation };
  struct Frames {
    std::string odom, base;
    bool publish_tf = true;
  };

  /// `propagates`: poses of both sources are published; those of frames alone are then also on TOPIC_at_frames.
  OdometryPublisher(ros::NodeHandle nh, const std::string& topic, bool propagates)
      : all_(nh.advertise<nav_msgs::Odometry>(topic, propagates ? 1000 : 50)) {
    if (propagates) at_frames_ = nh.advertise<nav_msgs::Odometry>(topic + "_at_frames", 50);
  }
  void setFrames(Frames frames) { frames_ = std::move(frames); }

  /// `twist`: of the base in its own axes (m/s, rad/s), with its covariance.
  void publish(urban_nav_core::StampNs stamp, const urban_nav_core::PoseWithCovariance& T_odom_base,
               const urban_nav_core::Vector6d& twist, const urban_nav_core::Matrix6d& twist_covariance, Source source) {
    nav_msgs::Odometry odometry = toOdometryMessage(stamp, T_odom_base, frames_.odom, frames_.base);
    setTwist(twist, twist_covariance, odometry);
    all_.publish(odometry);
    if (at_frames_ && source == Source::Frame) at_frames_.publish(odometry);
    if (!frames_.publish_tf) return;
    geometry_msgs::TransformStamped transform;
    transform.header = odometry.header;
    transform.child_frame_id = frames_.base;
    transform.transform = toTransformMessage(T_odom_base.pose);
    broadcaster_.sendTransform(transform);
  }

 private:
  ros::Publisher all_, at_frames_;
  tf2_ros::TransformBroadcaster broadcaster_;
  Frames frames_;
};

}  // namespace urban_nav_ros
