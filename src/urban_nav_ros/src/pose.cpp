// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/pose.hpp"

#include <cmath>
#include <memory>

#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/status.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav_ros {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::Quaterniond;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

namespace {

template <typename Translation, typename Rotation>
std::optional<Pose> toPose(const Translation& t, const Rotation& q) {
  const Quaterniond rotation(q.w, q.x, q.y, q.z);
  const Vector3d translation(t.x, t.y, t.z);
  if (!translation.allFinite() || !rotation.coeffs().allFinite() || std::abs(rotation.norm() - 1.0) > 0.01)
    return std::nullopt;
  return Pose(rotation, translation);
}

template <typename Translation, typename Rotation>
void fill(const Pose& pose, Translation& t, Rotation& q) {
  t.x = pose.t().x();
  t.y = pose.t().y();
  t.z = pose.t().z();
  q.x = pose.q().x();
  q.y = pose.q().y();
  q.z = pose.q().z();
  q.w = pose.q().w();
}

// Returns nullopt if the arrays do not match or a number is not finite.
std::optional<urban_nav_core::ConsideredConstants> toConstants(const urban_nav_msgs::RelativePose& message) {
  const std::size_t size = message.constants.size();
  if (message.constant_used.size() != size || message.constant_mean.size() != size ||
      message.constant_sigma.size() != size || message.sensitivity.size() != 6 * size)
    return std::nullopt;
  urban_nav_core::ConsideredConstants constants;
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Map<const urban_nav_core::Vector6d> sensitivity(&message.sensitivity[6 * i]);
    urban_nav_core::ConsideredConstant constant{message.constants[i], message.constant_used[i],
                                                message.constant_mean[i], message.constant_sigma[i], sensitivity};
    if (!isFinite(constant)) return std::nullopt;
    constants.push_back(std::move(constant));
  }
  return constants;
}

}  // namespace

std::optional<Pose> toPose(const geometry_msgs::Pose& message) { return toPose(message.position, message.orientation); }
std::optional<Pose> toPose(const geometry_msgs::Transform& message) {
  return toPose(message.translation, message.rotation);
}

geometry_msgs::Pose toPoseMessage(const Pose& pose) {
  geometry_msgs::Pose message;
  fill(pose, message.position, message.orientation);
  return message;
}

geometry_msgs::Transform toTransformMessage(const Pose& pose) {
  geometry_msgs::Transform message;
  fill(pose, message.translation, message.rotation);
  return message;
}

Matrix6d toMatrix6(const boost::array<double, 36>& values) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(values.data());
}

boost::array<double, 36> toArray36(const Matrix6d& matrix) {
  boost::array<double, 36> values;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(values.data()) = matrix;
  return values;
}

nav_msgs::Odometry toOdometryMessage(StampNs stamp, const PoseWithCovariance& T_frame_child, const std::string& frame,
                                     const std::string& child) {
  nav_msgs::Odometry message;
  message.header.stamp = toRosTime(stamp);
  message.header.frame_id = frame;
  message.child_frame_id = child;
  message.pose.pose = toPoseMessage(T_frame_child.pose);
  message.pose.covariance = toArray36(T_frame_child.covariance);
  return message;
}

void setTwist(const urban_nav_core::Vector6d& twist, const urban_nav_core::Matrix6d& covariance,
              nav_msgs::Odometry& message) {
  message.twist.twist.linear.x = twist[0];
  message.twist.twist.linear.y = twist[1];
  message.twist.twist.linear.z = twist[2];
  message.twist.twist.angular.x = twist[3];
  message.twist.twist.angular.y = twist[4];
  message.twist.twist.angular.z = twist[5];
  message.twist.covariance = toArray36(covariance);
}

urban_nav_msgs::OdometrySession toOdometrySessionMessage(const urban_nav_core::OdometrySession& session) {
  urban_nav_msgs::OdometrySession message;
  message.id = session.id;
  message.name = session.name;
  message.robot = session.robot;
  message.recording = session.recording;
  message.start = toRosTime(session.start);
  return message;
}

urban_nav_core::OdometrySessionPtr toOdometrySession(const urban_nav_msgs::OdometrySession& message) {
  if (!urban_nav_store::isStoredId(message.id)) return nullptr;
  return std::make_shared<const urban_nav_core::OdometrySession>(urban_nav_core::OdometrySession{
      message.id, message.name, message.robot, message.recording, toStampNs(message.start)});
}

urban_nav_msgs::RelativePose toRelativePoseMessage(const urban_nav_core::SessionStep& relative,
                                                   const std::string& child_frame) {
  urban_nav_msgs::RelativePose message;
  message.header.stamp = toRosTime(relative.to);
  message.header.frame_id = child_frame;
  message.from_stamp = toRosTime(relative.from);
  message.to_stamp = toRosTime(relative.to);
  message.child_frame = child_frame;
  message.T_from_to = toPoseMessage(relative.T_from_to);
  message.covariance = toArray36(relative.covariance);
  message.drift_covariance = toArray36(relative.drift_covariance);
  for (const urban_nav_core::ConsideredConstant& constant : relative.constants) {
    message.constants.push_back(constant.name);
    message.constant_used.push_back(constant.used);
    message.constant_mean.push_back(constant.mean);
    message.constant_sigma.push_back(constant.sigma);
    for (int i = 0; i < 6; ++i) message.sensitivity.push_back(constant.sensitivity[i]);
  }
  message.status = toMessage(relative.status.health);
  message.source = relative.source;
  if (relative.session) message.session = toOdometrySessionMessage(*relative.session);
  return message;
}

std::optional<urban_nav_core::RelativePose> toRelativePose(const urban_nav_msgs::RelativePose& message) {
  const std::optional<Pose> pose = toPose(message.T_from_to);
  const std::optional<urban_nav_core::Health> health = toHealth(message.status);
  if (!pose || !health) return std::nullopt;
  urban_nav_core::RelativePose relative;
  relative.from = toStampNs(message.from_stamp);
  relative.to = toStampNs(message.to_stamp);
  relative.T_from_to = *pose;
  relative.covariance = toMatrix6(message.covariance);
  relative.drift_covariance = toMatrix6(message.drift_covariance);
  if (!relative.covariance.allFinite() || !relative.drift_covariance.allFinite()) return std::nullopt;
  std::optional<urban_nav_core::ConsideredConstants> constants = toConstants(message);
  if (!constants) return std::nullopt;
  relative.constants = std::move(*constants);
  relative.status.health = *health;
  relative.source = message.source;
  return relative;
}

std::optional<urban_nav_core::SessionStep> toSessionStep(const urban_nav_msgs::RelativePose& message) {
  auto step = toRelativePose(message);
  if (!step) return std::nullopt;
  return urban_nav_core::SessionStep(std::move(*step), toOdometrySession(message.session));
}

}  // namespace urban_nav_ros
