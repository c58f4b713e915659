// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/path.hpp"

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::PoseRun;

PoseRun thinned(const PoseRun& run, double spacing) {
  PoseRun kept;
  kept.session = run.session;
  for (const auto& pose : run.poses) {
    const bool far =
        kept.poses.empty() || urban_nav_core::distanceBetween(kept.poses.back().T_map_base, pose.T_map_base) >= spacing;
    if (far) kept.poses.push_back(pose);
  }
  if (!run.poses.empty() && kept.poses.back().stamp != run.poses.back().stamp) kept.poses.push_back(run.poses.back());
  return kept;
}

nav_msgs::Path toPathMessage(const PoseRun& run, const std::string& map_frame) {
  nav_msgs::Path path;
  path.header.frame_id = map_frame;
  path.poses.reserve(run.poses.size());
  for (const auto& [stamp, T_map_base] : run.poses) {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = map_frame;
    pose.header.stamp = toRosTime(stamp);
    pose.pose = urban_nav_ros::toPoseMessage(T_map_base);
    path.poses.push_back(pose);
  }
  if (!path.poses.empty()) path.header.stamp = path.poses.back().header.stamp;
  return path;
}

}  // namespace urban_nav_ros
