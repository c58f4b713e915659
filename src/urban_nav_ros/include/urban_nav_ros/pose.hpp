// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Transform.h>
#include <nav_msgs/Odometry.h>
#include <urban_nav_msgs/OdometrySession.h>
#include <urban_nav_msgs/RelativePose.h>

#include <boost/array.hpp>
#include <optional>
#include <string>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_ros {

/// Converts a pose; empty if it is not finite or its quaternion is not of unit length (to 1 %).
std::optional<urban_nav_core::Pose> toPose(const geometry_msgs::Pose& message);
std::optional<urban_nav_core::Pose> toPose(const geometry_msgs::Transform& message);

geometry_msgs::Pose toPoseMessage(const urban_nav_core::Pose& pose);
geometry_msgs::Transform toTransformMessage(const urban_nav_core::Pose& pose);

/// Converts a row-major 6x6 matrix, translation first: ROS and the core use the same order.
urban_nav_core::Matrix6d toMatrix6(const boost::array<double, 36>& values);
boost::array<double, 36> toArray36(const urban_nav_core::Matrix6d& matrix);

/// Converts a pose of child_frame in frame_id with its covariance (in frame_id, DESIGN section 4). The twist is zero;
/// see setTwist().
nav_msgs::Odometry toOdometryMessage(urban_nav_core::StampNs stamp,
                                     const urban_nav_core::PoseWithCovariance& T_frame_child, const std::string& frame,
                                     const std::string& child);

/// Sets the velocity of child_frame in its own axes (m/s, rad/s), as defined by nav_msgs/Odometry.
void setTwist(const urban_nav_core::Vector6d& twist, const urban_nav_core::Matrix6d& covariance,
              nav_msgs::Odometry& message);

urban_nav_msgs::OdometrySession toOdometrySessionMessage(const urban_nav_core::OdometrySession& session);
/// Converts a session; null if the id is invalid.
urban_nav_core::OdometrySessionPtr toOdometrySession(const urban_nav_msgs::OdometrySession& message);

urban_nav_msgs::RelativePose toRelativePoseMessage(const urban_nav_core::SessionStep& relative,
                                                   const std::string& child_frame);
std::optional<urban_nav_core::RelativePose> toRelativePose(const urban_nav_msgs::RelativePose& message);
std::optional<urban_nav_core::SessionStep> toSessionStep(const urban_nav_msgs::RelativePose& message);

}  // namespace urban_nav_ros
