// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <nav_msgs/Odometry.h>
#include <urban_nav_msgs/LaserOdometryStatus.h>
#include <urban_nav_msgs/RelativePose.h>

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_ros/point_cloud.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/status.hpp"
#include "urban_nav_ros/topics.hpp"

namespace laser_odometry {

namespace topics = urban_nav_ros::topics;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;
using urban_nav_ros::toRosTime;

namespace {

constexpr std::chrono::seconds kMapPeriod(1);

}  // namespace

Publisher::Publisher(urban_nav_ros::StageNode& node, Frames frames)
    : node_(node),
      frames_(std::move(frames)),
      odometry_(node.nh().advertise<nav_msgs::Odometry>(topics::kLoOdometry, 50)),
      relative_(node.nh().advertise<urban_nav_msgs::RelativePose>(topics::kLoRelativePose, 200)),
      status_(node.nh().advertise<urban_nav_msgs::LaserOdometryStatus>(topics::kLoStatus, 50)),
      map_(node.nh().advertise<sensor_msgs::PointCloud2>(topics::kLoLocalMap, 1, true)) {}

void Publisher::publish(const LaserPose& pose, const urban_nav_core::OdometrySessionPtr& session, double process_ms) {
  if (pose.accepted) {
    publishOdometry(pose);
    // The first pose of a session is the origin and has no previous pose.
    if (pose.step.from != pose.step.to)
      relative_.publish(urban_nav_ros::toRelativePoseMessage({pose.step, session}, frames_.base));
  }
  publishStatus(pose, process_ms);
  node_.publishStatus(pose.status, toString(static_cast<Reason>(pose.status.reason)), pose.stamp);
}

void Publisher::publishOdometry(const LaserPose& pose) {
  nav_msgs::Odometry odometry =
      urban_nav_ros::toOdometryMessage(pose.stamp, {pose.T_odom_base, pose.covariance}, frames_.odom, frames_.base);
  if (pose.step.from != pose.step.to) {
    const double seconds = urban_nav_core::secondsBetween(pose.step.from, pose.step.to);
    // The step is in the axes of the previous pose, a velocity in those of this one.
    const Vector6d twist = urban_nav_core::logSe3(pose.step.T_from_to) / seconds;
    const Matrix6d J = urban_nav_core::rightFromBox(pose.step.T_from_to) / seconds;
    urban_nav_ros::setTwist(twist, urban_nav_core::transformCovariance(J, pose.step.covariance), odometry);
  }
  odometry_.publish(odometry);
  if (!frames_.publish_tf) return;
  geometry_msgs::TransformStamped transform;
  transform.header = odometry.header;
  transform.child_frame_id = frames_.base;
  transform.transform = urban_nav_ros::toTransformMessage(pose.T_odom_base);
  broadcaster_.sendTransform(transform);
}

void Publisher::publishStatus(const LaserPose& pose, double process_ms) {
  urban_nav_msgs::LaserOdometryStatus message;
  message.header.stamp = toRosTime(pose.stamp);
  message.header.frame_id = frames_.base;
  message.accepted = pose.accepted;
  message.status = urban_nav_ros::toMessage(pose.status.health);
  message.reason = pose.status.reason;
  message.reason_name = toString(static_cast<Reason>(pose.status.reason));
  message.message = pose.status.sentence;
  for (const Vector6d& direction : pose.free_directions)
    message.free_directions.insert(message.free_directions.end(), direction.data(), direction.data() + 6);
  const Statistics& figures = pose.statistics;
  message.points = static_cast<std::uint32_t>(figures.points);
  message.near = static_cast<std::uint32_t>(figures.near);
  message.used = static_cast<std::uint32_t>(figures.used);
  message.moving = static_cast<std::uint32_t>(figures.moving);
  message.patches = static_cast<std::uint32_t>(figures.patches);
  message.map_cells = static_cast<std::uint32_t>(figures.map_cells);
  message.residual_m = figures.residual_m;
  message.deskewed = figures.deskewed;
  message.process_ms = process_ms;
  message.latency_ms = (ros::Time::now() - message.header.stamp).toSec() * 1e3;
  status_.publish(message);
}

void Publisher::publishMap(const LiveLaserOdometry& odometry, urban_nav_core::StampNs stamp) {
  const auto now = std::chrono::steady_clock::now();
  if (map_.getNumSubscribers() == 0 || now < map_due_) return;
  map_due_ = now + kMapPeriod;
  std::vector<Eigen::Vector4f> points;
  for (const MapPoint& point : odometry.localMap())
    points.emplace_back(point.p_odom.x(), point.p_odom.y(), point.p_odom.z(), point.sigma);
  sensor_msgs::PointCloud2 cloud = urban_nav_ros::toPointCloudMessage(points, "sigma");
  cloud.header.stamp = toRosTime(stamp);
  cloud.header.frame_id = frames_.odom;
  map_.publish(cloud);
}

}  // namespace laser_odometry
