// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/graph.hpp"

#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::PoseRun;
using urban_nav_core::StampNs;

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

urban_nav_msgs::PoseRun toPoseRunMessage(const PoseRun& run) {
  urban_nav_msgs::PoseRun message;
  message.session = run.session;
  message.stamps.reserve(run.poses.size());
  message.T_map_base.reserve(run.poses.size());
  for (const auto& [stamp, T_map_base] : run.poses) {
    message.stamps.push_back(toRosTime(stamp));
    message.T_map_base.push_back(toPoseMessage(T_map_base));
  }
  return message;
}

std::optional<PoseRun> toPoseRun(const urban_nav_msgs::PoseRun& message) {
  if (message.stamps.size() != message.T_map_base.size()) return std::nullopt;
  PoseRun run;
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
  message.runs.reserve(update.runs.size());
  for (const PoseRun& run : update.runs) message.runs.push_back(toPoseRunMessage(run));
  return message;
}

std::optional<urban_nav_core::GraphUpdate> toGraphUpdate(const urban_nav_msgs::GraphUpdate& message) {
  urban_nav_core::GraphUpdate update;
  update.revision = static_cast<std::int64_t>(message.revision);
  update.previous = static_cast<std::int64_t>(message.previous);
  for (const urban_nav_msgs::PoseRun& part : message.runs) {
    auto run = toPoseRun(part);
    if (!run) return std::nullopt;
    update.runs.push_back(std::move(*run));
  }
  return update;
}

urban_nav_msgs::MapJump toMapJumpMessage(const urban_nav_core::MapJump& jump, const std::string& map_frame) {
  urban_nav_msgs::MapJump message;
  message.header.stamp = toRosTime(jump.at.stamp);
  message.header.frame_id = map_frame;
  message.revision = static_cast<std::uint64_t>(jump.revision);
  message.at = toPoseRefMessage(jump.at);
  message.T_map_base_before = toPoseMessage(jump.T_map_base_before);
  message.T_map_base_after = toPoseMessage(jump.T_map_base_after);
  message.distance = urban_nav_core::distanceBetween(jump.T_map_base_before, jump.T_map_base_after);
  message.angle = urban_nav_core::angleBetween(jump.T_map_base_before, jump.T_map_base_after);
  message.reason = jump.reason;
  message.reason_name = jump.reason_name;
  message.text = jump.sentence;
  for (const urban_nav_core::EdgeRef& witness : jump.witnesses) message.witnesses.push_back(toEdgeRefMessage(witness));
  return message;
}

std::optional<urban_nav_core::MapJump> toMapJump(const urban_nav_msgs::MapJump& message) {
  const auto before = toPose(message.T_map_base_before), after = toPose(message.T_map_base_after);
  if (!before || !after) return std::nullopt;
  urban_nav_core::MapJump jump;
  jump.revision = static_cast<std::int64_t>(message.revision);
  jump.at = toPoseRef(message.at);
  jump.T_map_base_before = *before;
  jump.T_map_base_after = *after;
  jump.reason = message.reason;
  jump.reason_name = message.reason_name;
  jump.sentence = message.text;
  for (const urban_nav_msgs::EdgeRef& witness : message.witnesses) jump.witnesses.push_back(toEdgeRef(witness));
  return jump;
}

}  // namespace urban_nav_ros
