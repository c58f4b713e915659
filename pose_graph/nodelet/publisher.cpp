// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <nav_msgs/Path.h>
#include <urban_nav_msgs/GraphState.h>
#include <urban_nav_msgs/GraphUpdate.h>
#include <urban_nav_msgs/MapJump.h>

#include "picture.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/path.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/status.hpp"

namespace pose_graph {

using urban_nav_core::PoseRun;
using urban_nav_core::StampNs;
using urban_nav_ros::toRosTime;

Publisher::Publisher(ros::NodeHandle& nh, const NodeletParameters& parameters)
    : parameters_(parameters),
      update_(nh.advertise<urban_nav_msgs::GraphUpdate>("graph/update", 100)),
      jump_(nh.advertise<urban_nav_msgs::MapJump>("graph/jump", 100)),
      path_(nh.advertise<nav_msgs::Path>("graph/path", 1, true)),
      state_(nh.advertise<urban_nav_msgs::GraphState>("graph/state", 1, true)),
      markers_(nh.advertise<visualization_msgs::MarkerArray>("graph/markers", 1, true)),
      status_(nh.advertise<urban_nav_msgs::StageStatus>("pose_graph/status", 10, true)),
      map_from_odom_(parameters.map_frame, parameters.odom_frame) {}

void Publisher::sendTransform(StampNs stamp) {
  if (parameters_.publish_tf) map_from_odom_.send(stamp);
}

void Publisher::publish(const urban_nav_core::GraphUpdate& update, StampNs newest) {
  update_.publish(urban_nav_ros::toGraphUpdateMessage(update, newest, parameters_.map_frame));
}

void Publisher::publish(const urban_nav_core::MapJump& jump) {
  jump_.publish(urban_nav_ros::toMapJumpMessage(jump, parameters_.map_frame));
}

void Publisher::publish(const Figures& figures, StampNs newest) {
  urban_nav_msgs::GraphState message;
  message.header.stamp = toRosTime(newest);
  message.header.frame_id = parameters_.map_frame;
  message.revision = static_cast<std::uint64_t>(figures.revision);
  message.sessions = static_cast<std::uint32_t>(figures.sessions);
  message.sessions_joined = static_cast<std::uint32_t>(figures.sessions_joined);
  message.poses = static_cast<std::uint64_t>(figures.poses);
  message.edges = static_cast<std::uint64_t>(figures.edges);
  message.closures = static_cast<std::uint64_t>(figures.closures);
  message.closures_rejected = static_cast<std::uint64_t>(figures.closures_rejected);
  message.closures_waiting = static_cast<std::uint64_t>(figures.closures_waiting);
  message.cost_before = figures.cost_before;
  message.cost_after = figures.cost_after;
  message.relax_ms = figures.relax_ms;
  state_.publish(message);
}

void Publisher::publish(const urban_nav_core::Status& status, const std::string& reason_name, StampNs newest) {
  const auto message = urban_nav_ros::toStatusMessage(newest, "pose_graph", status, reason_name);
  if (last_status_ && last_status_->status == message.status && last_status_->reason == message.reason) return;
  last_status_ = message;
  status_.publish(message);
}

bool Publisher::isWatched() const { return path_.getNumSubscribers() > 0 || markers_.getNumSubscribers() > 0; }

void Publisher::publishPicture(const std::vector<PoseRun>& runs, const std::vector<Tie>& ties, StampNs newest) {
  std::vector<PoseRun> drawn;
  drawn.reserve(runs.size());
  for (const PoseRun& run : runs) drawn.push_back(urban_nav_ros::thinned(run, parameters_.picture_spacing));
  if (!drawn.empty()) path_.publish(urban_nav_ros::toPathMessage(drawn.back(), parameters_.map_frame));
  markers_.publish(toMarkers(ties, drawn, newest, parameters_.map_frame));
}

}  // namespace pose_graph
