// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <urban_nav_msgs/RelativePose.h>
#include <urban_nav_msgs/VoStatistics.h>

#include <tuple>

#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/path.hpp"
#include "urban_nav_ros/point_cloud.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/status.hpp"
#include "urban_nav_ros/topics.hpp"

namespace swf_vo {

namespace topics = urban_nav_ros::topics;
using urban_nav_ros::toRosTime;
using Source = urban_nav_ros::OdometryPublisher::Source;

namespace {
constexpr double kPathSpacing = 0.5;  // m, for display
constexpr std::size_t kPathPoints = 4000;
}  // namespace

Publisher::Publisher(urban_nav_ros::StageNode& node, bool imu_rate)
    : node_(node),
      odometry_(node.nh(), topics::kVoOdometry, imu_rate),
      relative_(node.nh().advertise<urban_nav_msgs::RelativePose>(topics::kVoRelativePose, 200)),
      frame_(node.nh().advertise<urban_nav_msgs::VoStatistics>(topics::kVoStatistics, 50)),
      landmarks_(node.nh().advertise<sensor_msgs::PointCloud2>(topics::kVoLandmarks, 5)),
      tracks_(node.nh().advertise<sensor_msgs::Image>(topics::kVoTracks, 2)),
      path_(node.nh().advertise<nav_msgs::Path>(topics::kVoPath, 1, true)) {}

void Publisher::startSession(const Frames& frames, double near_disparity_px) {
  frames_ = frames;
  odometry_.setFrames({frames.odom, frames.base, frames.publish_tf});
  drawn_path_.header.frame_id = frames.odom;
  drawn_path_.poses.clear();
  node_.restartStatus();
  picture_ = std::make_unique<TracksPicture>(near_disparity_px);
}

void Publisher::publish(const Frame& frame, const urban_nav_core::OdometrySessionPtr& session,
                        const urban_nav_core::StereoPair& pair, double process_ms) {
  publishFrame(frame, process_ms);  // first: stages correct the images of a pose by its turn of the right camera
  if (frame.accepted) {
    odometry_.publish(frame.stamp, frame.T_odom_base, frame.velocity.twist, frame.velocity.covariance, Source::Frame);
    if (urban_nav_ros::appendToPath(frame.stamp, frame.T_odom_base.pose, kPathSpacing, kPathPoints, drawn_path_))
      path_.publish(drawn_path_);
    publishLandmarks(frame);
    publishTracks(frame, pair.left);
  }
  node_.publishStatus(frame.status, toString(static_cast<Reason>(frame.status.reason)), frame.stamp);
  for (const Settled& settled : frame.settled) publish(settled, session);
}

void Publisher::publish(const Settled& settled, const urban_nav_core::OdometrySessionPtr& session) {
  if (settled.from_previous.from == settled.from_previous.to) return;  // the first pose of a session
  relative_.publish(urban_nav_ros::toRelativePoseMessage({settled.from_previous, session}, frames_.base));
}

void Publisher::publish(const PropagatedPose& pose) {
  odometry_.publish(pose.stamp, pose.T_odom_base, pose.velocity.twist, pose.velocity.covariance, Source::Propagation);
}

void Publisher::publishFrame(const Frame& frame, double process_ms) {
  urban_nav_msgs::VoStatistics message;
  message.header.stamp = toRosTime(frame.stamp);
  message.header.frame_id = frames_.camera;
  message.frame = static_cast<std::uint64_t>(frame.frame);
  message.accepted = frame.accepted;
  message.status = urban_nav_ros::toMessage(frame.status.health);
  message.reason = frame.status.reason;
  message.reason_name = toString(static_cast<Reason>(frame.status.reason));
  message.message = frame.status.sentence;
  const Statistics& figures = frame.statistics;
  message.corners = static_cast<std::uint32_t>(figures.corners);
  message.features = static_cast<std::uint32_t>(figures.features);
  message.tracked = static_cast<std::uint32_t>(figures.tracked);
  message.iterations = static_cast<std::uint32_t>(figures.iterations);
  message.landmarks = static_cast<std::uint32_t>(figures.landmarks);
  message.landmarks_in_prior = static_cast<std::uint32_t>(figures.landmarks_in_prior);
  const MotionComparison& compared = frame.motion.newest;
  Eigen::Map<Eigen::Vector3d>(message.turn.data()) = compared.turn;
  Eigen::Map<Eigen::Vector3d>(message.turn_error.data()) = compared.turn_error;
  Eigen::Map<Eigen::Vector3d>(message.right_turn.data()) = figures.right_turn_rad;
  std::tie(message.turn_sigma, message.forward, message.sideways, message.forward_error, message.forward_sigma,
           message.imu_delay, message.imu_delay_sigma, message.wheel_delay, message.wheel_delay_sigma,
           message.track_length_mean, message.reprojection_px, message.disparity_offset_px,
           message.disparity_offset_sigma_px, message.disparity_step_px, message.disparity_step_sigma_px) =
      std::tie(compared.turn_sigma, compared.forward, compared.sideways, compared.forward_error, compared.forward_sigma,
               frame.motion.imu_offset_s, frame.motion.imu_offset_sigma_s, frame.motion.wheel_offset_s,
               frame.motion.wheel_offset_sigma_s, figures.track_length_mean, figures.reprojection_px,
               figures.disparity_offset_px, figures.disparity_offset_sigma_px, figures.disparity_step.px,
               figures.disparity_step.sigma_px);
  message.gyroscope_fault = currentFault(frame.motion, false);
  message.wheels_fault = currentFault(frame.motion, true);
  message.process_ms = process_ms;
  message.latency_ms = (ros::Time::now() - message.header.stamp).toSec() * 1e3;
  frame_.publish(message);
}

void Publisher::publishLandmarks(const Frame& frame) {
  if (landmarks_.getNumSubscribers() == 0) return;
  std::vector<Eigen::Vector4f> points;
  points.reserve(frame.landmarks.size());
  for (const Landmark& landmark : frame.landmarks) {
    const Eigen::Vector3f p = landmark.p_odom.cast<float>();
    points.emplace_back(p.x(), p.y(), p.z(), landmark.sigma);
  }
  sensor_msgs::PointCloud2 cloud = urban_nav_ros::toPointCloudMessage(points, "sigma");
  cloud.header.stamp = toRosTime(frame.stamp);
  cloud.header.frame_id = frames_.odom;
  landmarks_.publish(cloud);
}

void Publisher::publishTracks(const Frame& frame, const urban_nav_core::ImageView& left) {
  if (tracks_.getNumSubscribers() == 0) return;
  const cv::Mat& picture = picture_->draw(left, frame);
  if (picture.empty()) return;
  sensor_msgs::Image message = urban_nav_ros::toColourImageMessage(picture);
  message.header.stamp = toRosTime(frame.stamp);
  message.header.frame_id = frames_.camera;
  tracks_.publish(message);
}

}  // namespace swf_vo
