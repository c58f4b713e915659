// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/graph.hpp"

#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::StampNs;
using urban_nav_core::TrajectorySegment;

urban_nav_msgs::EdgeRef toEdgeRefMessage(const urban_nav_core::EdgeRef& edge) {
  urban_nav_msgs::EdgeRef message;
  message.a = toPoseRefMessage(edge.a);
  message.b = toPoseRefMessage(edge.b);
  message.kind = edge.kind;
  message.source = edge.source;
  return message;
}

urban_nav_core::EdgeRef toEdgeRef(const urban_nav_msgs::EdgeRef& message) {
  return {toPoseRef(message.a), toPoseRef(message.b), message.kind, message.source};
}

urban_nav_msgs::TrajectorySegment toTrajectorySegmentMessage(const TrajectorySegment& run) {
  urban_nav_msgs::TrajectorySegment message;
  message.session = run.session;
  message.stamps.reserve(run.poses.size());
  message.T_map_base.reserve(run.poses.size());
  for (const auto& [stamp, T_map_base] : run.poses) {
    message.stamps.push_back(toRosTime(stamp));
    message.T_map_base.push_back(toPoseMessage(T_map_base));
  }
  return message;
}

std::optional<TrajectorySegment> toTrajectorySegment(const urban_nav_msgs::TrajectorySegment& message) {
  if (message.stamps.size() != message.T_map_base.size()) return std::nullopt;
  TrajectorySegment run;
  run.session = message.session;
  run.poses.reserve(message.stamps.size());
  for (std::size_t i = 0; i < message.stamps.size(); ++i) {
    const auto T_map_base = toPose(message.T_map_base[i]);
    const StampNs stamp = toStampNs(message.stamps[i]);
    if (!T_map_base || (i > 0 && stamp <= run.poses.back().stamp)) return std::nullopt;
    run.poses.push_back({stamp, *T_map_base});
  }
  return run;
}

urban_nav_msgs::GraphUpdate toGraphUpdateMessage(const urban_nav_core::GraphUpdate& update, StampNs newest,
                                                 const std::string& map_frame) {
  urban_nav_msgs::GraphUpdate message;
  message.header.stamp = toRosTime(newest);
  message.header.frame_id = map_frame;
  message.revision = static_cast<std::uint64_t>(update.revision);
  message.previous = static_cast<std::uint64_t>(update.previous);
  message.segments.reserve(update.segments.size());
  for (const TrajectorySegment& run : update.segments) message.segments.push_back(toTrajectorySegmentMessage(run));
  return message;
}

std::optional<urban_nav_core::GraphUpdate> toGraphUpdate(const urban_nav_msgs::GraphUpdate& message) {
  urban_nav_core::GraphUpdate update;
  update.revision = static_cast<std::int64_t>(message.revision);
  update.previous = static_cast<std::int64_t>(message.previous);
  for (const urban_nav_msgs::TrajectorySegment& part : message.segments) {
    auto run = toTrajectorySegment(part);
    if (!run) return std::nullopt;
    update.segments.push_back(std::move(*run));
  }
  return update;
}

urban_nav_msgs::PoseCorrection toPoseCorrectionMessage(const urban_nav_core::PoseCorrection& correction,
                                                       const std::string& map_frame) {
  urban_nav_msgs::PoseCorrection message;
  message.header.stamp = toRosTime(correction.at.stamp);
  message.header.frame_id = map_frame;
  message.revision = static_cast<std::uint64_t>(correction.revision);
  message.at = toPoseRefMessage(correction.at);
  message.T_map_base_before = toPoseMessage(correction.T_map_base_before);
  message.T_map_base_after = toPoseMessage(correction.T_map_base_after);
  message.distance = urban_nav_core::distanceBetween(correction.T_map_base_before, correction.T_map_base_after);
  message.angle = urban_nav_core::angleBetween(correction.T_map_base_before, correction.T_map_base_after);
  message.reason = correction.reason;
  message.reason_name = correction.reason_name;
  message.message = correction.sentence;
  for (const urban_nav_core::EdgeRef& edge : correction.causing_edges)
    message.causing_edges.push_back(toEdgeRefMessage(edge));
  return message;
}

std::optional<urban_nav_core::PoseCorrection> toPoseCorrection(const urban_nav_msgs::PoseCorrection& message) {
  const auto before = toPose(message.T_map_base_before), after = toPose(message.T_map_base_after);
  if (!before || !after) return std::nullopt;
  urban_nav_core::PoseCorrection correction;
  correction.revision = static_cast<std::int64_t>(message.revision);
  correction.at = toPoseRef(message.at);
  correction.T_map_base_before = *before;
  correction.T_map_base_after = *after;
  correction.reason = message.reason;
  correction.reason_name = message.reason_name;
  correction.sentence = message.message;
  for (const urban_nav_msgs::EdgeRef& edge : message.causing_edges) correction.causing_edges.push_back(toEdgeRef(edge));
  return correction;
}

}  // namespace urban_nav_ros
