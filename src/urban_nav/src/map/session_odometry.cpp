// SPDX-License-Identifier: BSD-3-Clause
#include "map/session_odometry.hpp"

#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav {

std::string describeCameras(const SessionOdometry& odometry) {
  if (!odometry.cameras.empty()) return odometry.cameras;
  return urban_nav_registration::calibrationFingerprint(odometry.camera, odometry.T_base_camera);
}

urban_nav_core::Trajectory smoothedTrajectory(const SessionOdometry& run) {
  urban_nav_core::Trajectory trajectory;
  for (const SmoothedFrame& settled : run.settled) trajectory.append(settled.stamp, settled.T_odom_base.pose);
  return trajectory;
}

urban_nav_core::OdometryChain odometryChain(const SessionOdometry& run) {
  urban_nav_core::OdometryChain odometry;
  for (std::size_t i = 1; i < run.settled.size(); ++i) odometry.append(run.settled[i].from_previous);
  return odometry;
}

void turnOdometry(const Eigen::Quaterniond& q_level_odom, SessionOdometry& run) {
  const urban_nav_core::Pose T_level_odom(q_level_odom, Eigen::Vector3d::Zero());
  for (OdometryFrame& frame : run.frames) frame.T_odom_base = T_level_odom * frame.T_odom_base;
  for (SmoothedFrame& frame : run.settled) frame.T_odom_base.pose = T_level_odom * frame.T_odom_base.pose;
}

}  // namespace urban_nav
