// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <nav_msgs/Path.h>
#include <urban_nav_msgs/GraphState.h>

#include "markers.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/path.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace pose_graph {

namespace topics = urban_nav_ros::topics;
using urban_nav_core::StampNs;
using urban_nav_core::TrajectorySegment;

namespace {

urban_nav_msgs::GraphState toStateMessage(const Figures& figures, double relax_ms, StampNs newest,
                                          const std::string& map_frame) {
  urban_nav_msgs::GraphState message;
  message.header.stamp = urban_nav_ros::toRosTime(newest);
  message.header.frame_id = map_frame;
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
  message.relax_ms = relax_ms;
  return message;
}

}  // namespace

Publisher::Publisher(ros::NodeHandle& nh, const NodeletParameters& parameters)
    : parameters_(parameters),
      update_(nh.advertise<urban_nav_msgs::GraphUpdate>(topics::kGraphUpdate, 100)),
      correction_(nh.advertise<urban_nav_msgs::PoseCorrection>(topics::kGraphCorrection, 100)),
      path_(nh.advertise<nav_msgs::Path>(topics::kGraphPath, 1, true)),
      state_(nh.advertise<urban_nav_msgs::GraphState>(topics::kGraphState, 1, true)),
      verdicts_(nh.advertise<urban_nav_msgs::MetricClosure>(topics::kGraphVerdicts, 1000)),
      markers_(nh.advertise<visualization_msgs::MarkerArray>(topics::kGraphMarkers, 1, true)),
      map_from_odom_(parameters.map_frame, parameters.odom_frame) {}

void Publisher::sendTransform(StampNs stamp) {
  if (parameters_.publish_tf) map_from_odom_.send(stamp);
}

void Publisher::publish(const LiveGraph::Outcome& outcome, StampNs newest, double relax_ms) {
  const std::string& frame = parameters_.map_frame;
  if (outcome.update) update_.publish(urban_nav_ros::toGraphUpdateMessage(*outcome.update, newest, frame));
  for (const urban_nav_core::PoseCorrection& correction : outcome.corrections)
    correction_.publish(urban_nav_ros::toPoseCorrectionMessage(correction, frame));
  for (const urban_nav_core::MetricClosure& closure : outcome.verdicts)
    verdicts_.publish(urban_nav_ros::toMetricClosureMessage(closure, parameters_.base_frame, 1.0));
  state_.publish(toStateMessage(outcome.figures, relax_ms, newest, frame));
}

bool Publisher::isWatched() const { return path_.getNumSubscribers() > 0 || markers_.getNumSubscribers() > 0; }

void Publisher::publish(const LiveGraph::Picture& picture, StampNs newest) {
  std::vector<TrajectorySegment> drawn;
  drawn.reserve(picture.segments.size());
  for (const TrajectorySegment& run : picture.segments)
    drawn.push_back(urban_nav_ros::thinned(run, parameters_.path_spacing));
  if (!drawn.empty()) path_.publish(urban_nav_ros::toPathMessage(drawn.back(), parameters_.map_frame));
  markers_.publish(toMarkers(picture.closures, drawn, newest, parameters_.map_frame));
}

}  // namespace pose_graph
