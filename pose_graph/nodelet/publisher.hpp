// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "live/live_graph.hpp"
#include "live/nodelet_parameters.hpp"
#include "urban_nav_ros/map_from_odom.hpp"
#include "urban_nav_ros/stage_node.hpp"

namespace pose_graph {

/// Converts outputs of the graph to messages and tf. T_map_odom is thread-safe; all else is used by the worker only.
class Publisher {
 public:
  Publisher(ros::NodeHandle& nh, const NodeletParameters& parameters);

  /// Sets map -> odom; empty: unknown.
  void setMapFromOdom(const std::optional<urban_nav_core::Pose>& T_map_odom) { map_from_odom_.set(T_map_odom); }
  /// Publishes map -> odom with the stamp of an odometry message, unless tf is disabled.
  void sendTransform(urban_nav_core::StampNs stamp);

  void publish(const LiveGraph::Outcome& outcome, urban_nav_core::StampNs newest, double relax_ms);

  /// Returns whether a path or markers have subscribers.
  bool isWatched() const;
  /// Publishes graph/path (of the last segment) and graph/markers.
  void publish(const LiveGraph::Picture& picture, urban_nav_core::StampNs newest);

 private:
  const NodeletParameters parameters_;
  ros::Publisher update_, correction_, path_, state_, verdicts_, markers_;
  urban_nav_ros::MapFromOdom map_from_odom_;
};

}  // namespace pose_graph
