// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/path.hpp"

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::TrajectorySegment;

TrajectorySegment thinned(const TrajectorySegment& run, double spacing) {
  TrajectorySegment kept;
  kept.session = run.session;
  for (const auto& pose : run.poses) {
    const bool far =
        kept.poses.empty() || urban_nav_core::distanceBetween(kept.poses.back().T_map_base, pose.T_map_base) >= spacing;
    if (far) kept.poses.push_back(pose);
  }
  if (!run.poses.empty() && kept.poses.back().stamp != run.poses.back().stamp) kept.poses.push_back(run.poses.back());
  return kept;
}

nav_msgs::Path toPathMessage(const TrajectorySegment& run, const std::string& map_frame) {
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

bool appendToPath(urban_nav_core::StampNs stamp, const urban_nav_core::Pose& pose, double spacing,
                  std::size_t max_points, nav_msgs::Path& path) {
  if (!path.poses.empty()) {
    const auto last = toPose(path.poses.back().pose);
    if (last && urban_nav_core::distanceBetween(*last, pose) < spacing) return false;
  }
  if (path.poses.size() >= max_points)
    path.poses.erase(path.poses.begin(), path.poses.begin() + static_cast<std::ptrdiff_t>(max_points / 10));
  path.header.stamp = toRosTime(stamp);
  geometry_msgs::PoseStamped message;
  message.header = path.header;
  message.pose = toPoseMessage(pose);
  path.poses.push_back(message);
  return true;
}

}  // namespace urban_nav_ros
