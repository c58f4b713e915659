// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <urban_nav_msgs/StageStatus.h>

#include <optional>
#include <vector>

#include "live_graph.hpp"
#include "nodelet_parameters.hpp"
#include "urban_nav_ros/map_from_odom.hpp"

namespace pose_graph {

/// What the graph says -> messages and tf. map -> odom is thread-safe; the rest is used by the worker alone.
class Publisher {
 public:
  Publisher(ros::NodeHandle& nh, const NodeletParameters& parameters);

  /// From now on map -> odom is this; empty: not known yet.
  void setMapFromOdom(const std::optional<urban_nav_core::Pose>& T_map_odom) { map_from_odom_.set(T_map_odom); }
  /// Publishes it with the stamp of an odometry message, where tf is wanted.
  void sendTransform(urban_nav_core::StampNs stamp);

  void publish(const urban_nav_core::GraphUpdate& update, urban_nav_core::StampNs newest);
  void publish(const urban_nav_core::MapJump& jump);
  void publish(const Figures& figures, urban_nav_core::StampNs newest);
  /// When it changes.
  void publish(const urban_nav_core::Status& status, const std::string& reason_name, urban_nav_core::StampNs newest);

  /// Whether anyone would see a picture.
  bool isWatched() const;
  /// `runs`: the map's trajectories, the one of the running session last; it becomes graph/path.
  void publishPicture(const std::vector<urban_nav_core::PoseRun>& runs, const std::vector<Tie>& ties,
                      urban_nav_core::StampNs newest);

 private:
  const NodeletParameters parameters_;
  ros::Publisher update_, jump_, path_, state_, markers_, status_;
  std::optional<urban_nav_msgs::StageStatus> last_status_;
  urban_nav_ros::MapFromOdom map_from_odom_;
};

}  // namespace pose_graph
