// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/map_from_odom.hpp"

#include <utility>

#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::StampNs;

namespace {

// Stamps kept while map -> odom is unknown: 10 s, the duration of the tf buffer, at 20 Hz.
constexpr std::size_t kMostUnsent = 200;

}  // namespace

MapFromOdom::MapFromOdom(std::string map_frame, std::string odom_frame)
    : map_frame_(std::move(map_frame)), odom_frame_(std::move(odom_frame)) {}

void MapFromOdom::set(const std::optional<urban_nav_core::Pose>& T_map_odom) {
  const std::lock_guard<std::mutex> lock(mutex_);
  T_map_odom_ = T_map_odom;
  if (T_map_odom_) sendAll(std::exchange(unsent_, {}));
}

void MapFromOdom::send(StampNs stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (T_map_odom_) return sendAll({stamp});
  if (unsent_.size() >= kMostUnsent) unsent_.erase(unsent_.begin());
  unsent_.push_back(stamp);
}

void MapFromOdom::sendAll(const std::vector<StampNs>& stamps) {
  if (stamps.empty()) return;
  std::vector<geometry_msgs::TransformStamped> transforms(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    transforms[i].header.stamp = toRosTime(stamps[i]);
    transforms[i].header.frame_id = map_frame_;
    transforms[i].child_frame_id = odom_frame_;
    transforms[i].transform = toTransformMessage(*T_map_odom_);
  }
  broadcaster_.sendTransform(transforms);
}

}  // namespace urban_nav_ros
