// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/VoFrame.h>

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/status.hpp"

namespace swf_vo {

using urban_nav_ros::toRosTime;

namespace {

// The path is for pictures: a point where the robot has moved on this far, and not more of them than a viewer draws
// with ease.
constexpr double path_step = 0.5;  // m
constexpr std::size_t path_points = 4000;

const char* reasonName(const urban_nav_core::Status& status) { return toString(static_cast<Reason>(status.reason)); }

}  // namespace

Publisher::Publisher(ros::NodeHandle& nh)
    : odometry_(nh.advertise<nav_msgs::Odometry>("vo/odometry", 50)),
      relative_(nh.advertise<urban_nav_msgs::RelativePose>("vo/relative_pose", 200)),
      frame_(nh.advertise<urban_nav_msgs::VoFrame>("vo/frame", 50)),
      landmarks_(nh.advertise<sensor_msgs::PointCloud2>("vo/landmarks", 5)),
      tracks_(nh.advertise<sensor_msgs::Image>("vo/tracks", 2)),
      path_(nh.advertise<nav_msgs::Path>("vo/path", 1, true)),
      status_(nh.advertise<urban_nav_msgs::StageStatus>("swf_vo/status", 10, true)) {}

void Publisher::startSession(const Frames& frames, double near_disparity_px) {
  frames_ = frames;
  way_.header.frame_id = frames.odom;
  way_.poses.clear();
  last_status_ = {};
  picture_ = std::make_unique<TracksPicture>(near_disparity_px);
}

void Publisher::publish(const Frame& frame, const urban_nav_core::StereoPair& pair, double process_ms) {
  if (frame.accepted) {
    publishOdometry(frame);
    publishPath(frame);
    publishLandmarks(frame);
    publishTracks(frame, pair.left);
  }
  publishFrame(frame, process_ms);
  publishStatus(frame);
  for (const Settled& settled : frame.settled) publish(settled);
}

void Publisher::publish(const Settled& settled) {
  // The first pose of a session is the origin: it has no neighbour to be related to.
  if (settled.from_previous.from == settled.from_previous.to) return;
  relative_.publish(urban_nav_ros::toRelativePoseMessage(settled.from_previous, frames_.base));
}

void Publisher::publishOdometry(const Frame& frame) {
  nav_msgs::Odometry odometry =
      urban_nav_ros::toOdometryMessage(frame.stamp, frame.T_odom_base, frames_.odom, frames_.base);
  urban_nav_ros::setTwist(frame.velocity.twist, frame.velocity.covariance, odometry);
  odometry_.publish(odometry);
  if (!frames_.publish_tf) return;
  geometry_msgs::TransformStamped transform;
  transform.header = odometry.header;
  transform.child_frame_id = frames_.base;
  transform.transform = urban_nav_ros::toTransformMessage(frame.T_odom_base.pose);
  broadcaster_.sendTransform(transform);
}

void Publisher::publishFrame(const Frame& frame, double process_ms) {
  urban_nav_msgs::VoFrame message;
  message.header.stamp = toRosTime(frame.stamp);
  message.header.frame_id = frames_.camera;
  message.frame = static_cast<std::uint64_t>(frame.frame);
  message.accepted = frame.accepted;
  message.status = urban_nav_ros::toMessage(frame.status.health);
  message.reason = frame.status.reason;
  message.reason_name = reasonName(frame.status);
  message.text = frame.status.sentence;
  const Statistics& figures = frame.statistics;
  message.corners = static_cast<std::uint32_t>(figures.corners);
  message.features = static_cast<std::uint32_t>(figures.features);
  message.tracked = static_cast<std::uint32_t>(figures.tracked);
  message.track_length_mean = figures.track_length_mean;
  message.reprojection_px = figures.reprojection_px;
  message.iterations = static_cast<std::uint32_t>(figures.iterations);
  message.landmarks = static_cast<std::uint32_t>(figures.landmarks);
  message.landmarks_in_prior = static_cast<std::uint32_t>(figures.landmarks_in_prior);
  message.disparity_offset_px = figures.disparity_offset_px;
  message.disparity_offset_sigma_px = figures.disparity_offset_sigma_px;
  message.process_ms = process_ms;
  message.latency_ms = (ros::Time::now() - message.header.stamp).toSec() * 1e3;
  frame_.publish(message);
}

void Publisher::publishStatus(const Frame& frame) {
  const urban_nav_msgs::StageStatus status =
      urban_nav_ros::toStatusMessage(frame.stamp, "swf_vo", frame.status, reasonName(frame.status));
  if (!last_status_.stage.empty() && status.status == last_status_.status && status.reason == last_status_.reason)
    return;
  last_status_ = status;
  status_.publish(status);
}

void Publisher::publishPath(const Frame& frame) {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = toRosTime(frame.stamp);
  pose.header.frame_id = frames_.odom;
  pose.pose = urban_nav_ros::toPoseMessage(frame.T_odom_base.pose);
  if (!way_.poses.empty()) {
    const auto last = urban_nav_ros::toPose(way_.poses.back().pose);
    if (last && urban_nav_core::distanceBetween(*last, frame.T_odom_base.pose) < path_step) return;
  }
  if (way_.poses.size() >= path_points) way_.poses.erase(way_.poses.begin(), way_.poses.begin() + path_points / 10);
  way_.poses.push_back(pose);
  way_.header.stamp = pose.header.stamp;
  path_.publish(way_);
}

void Publisher::publishLandmarks(const Frame& frame) {
  if (landmarks_.getNumSubscribers() == 0) return;
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = toRosTime(frame.stamp);
  cloud.header.frame_id = frames_.odom;
  sensor_msgs::PointCloud2Modifier fields(cloud);
  using sensor_msgs::PointField;
  fields.setPointCloud2Fields(4, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1, PointField::FLOAT32,
                              "sigma", 1, PointField::FLOAT32);
  fields.resize(frame.landmarks.size());
  sensor_msgs::PointCloud2Iterator<float> at(cloud, "x");
  for (const Landmark& landmark : frame.landmarks) {
    at[0] = static_cast<float>(landmark.p_odom.x());
    at[1] = static_cast<float>(landmark.p_odom.y());
    at[2] = static_cast<float>(landmark.p_odom.z());
    at[3] = landmark.sigma;
    ++at;
  }
  landmarks_.publish(cloud);
}

void Publisher::publishTracks(const Frame& frame, const urban_nav_core::ImageView& left) {
  if (tracks_.getNumSubscribers() == 0) return;
  const cv::Mat& picture = picture_->draw(left, frame);
  if (picture.empty()) return;
  sensor_msgs::Image message;
  message.header.stamp = toRosTime(frame.stamp);
  message.header.frame_id = frames_.camera;
  message.encoding = "bgr8";
  message.width = static_cast<std::uint32_t>(picture.cols);
  message.height = static_cast<std::uint32_t>(picture.rows);
  message.step = static_cast<std::uint32_t>(picture.cols * picture.elemSize());
  message.data.assign(picture.datastart, picture.dataend);
  tracks_.publish(message);
}

}  // namespace swf_vo
