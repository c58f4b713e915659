// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/results/pose_topics.hpp"

#include <tf2_msgs/TFMessage.h>

#include <map>
#include <optional>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/path.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/status.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_store::Node;
using urban_nav_store::StoredTrajectory;

namespace frames = urban_nav_core::frames;

namespace topics = urban_nav_ros::topics;

namespace {

geometry_msgs::TransformStamped stampedTransform(urban_nav_core::StampNs stamp, const char* parent, const char* child,
                                                 const Pose& T_parent_child) {
  geometry_msgs::TransformStamped message = urban_nav_ros::toStaticTransform(parent, child, T_parent_child);
  message.header.stamp = urban_nav_ros::toRosTime(stamp);
  return message;
}

/// Returns the matrix that rotates both halves of a tangent.
Matrix6d bothRotations(const urban_nav_core::Matrix3d& R) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = R;
  return both;
}

/// Sets the mean velocity since the previous node, in the axes of base_link at this node.
void setMeanTwist(const Node& before, const Node& node, nav_msgs::Odometry& message) {
  const double seconds = urban_nav_core::secondsBetween(before.stamp, node.stamp);
  if (seconds <= 0.0) return;
  const Pose step = before.T_odom_base.inverse() * node.T_odom_base;
  urban_nav_core::Vector6d moved;
  moved << step.t(), urban_nav_core::logSo3(step.q());
  const Matrix6d turn = bothRotations(step.R().transpose());
  urban_nav_ros::setTwist(turn * moved / seconds, turn * node.covariance * turn.transpose() / (seconds * seconds),
                          message);
}

/// Returns the source of the odometry steps of a session: "swf_vo"; empty without steps.
std::string odometrySource(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  std::string source;
  store.graph().forEachEdge(session, [&](const urban_nav_store::Edge& edge) {
    if (source.empty() && edge.kind == urban_nav_store::EdgeKind::Odometry) source = edge.source;
  });
  return source;
}

/// Writes the messages for each pose of a session.
class SessionPoses {
 public:
  SessionPoses(urban_nav_store::Store& store, const RecordedMap& map, const StoredTrajectory& session,
               BagWriter& recording)
      : map_(map),
        session_(session),
        source_(odometrySource(store, session.session.id)),
        recording_(recording),
        R_map_first_(bothRotations(map.sessions().front().T_map_base.front().pose.R())) {
    store.graph().forEachRelaxed(session.session.id, [this](const urban_nav_store::RelaxedPose& pose) {
      relaxed_.emplace_hint(relaxed_.end(), pose.stamp, pose.covariance);
    });
  }

  void add(const Node& node) {
    const Pose& T_map_base = session_.T_map_base.at(next_++).pose;
    const auto relaxed = relaxed_.find(node.stamp);
    const Matrix6d& covariance = relaxed != relaxed_.end() ? relaxed->second : node.covariance_from_first;
    nav_msgs::Odometry odometry =
        urban_nav_ros::toOdometryMessage(node.stamp, {T_map_base, R_map_first_ * covariance * R_map_first_.transpose()},
                                         map_.frame(), frames::kBaseLink);
    if (before_) setMeanTwist(*before_, node, odometry);
    recording_.write(topics::results::kOdometry, node.stamp, odometry);
    writeTransforms(node, T_map_base);
    if (!before_ || before_->status != node.status)
      recording_.write(topics::results::kStatus, node.stamp,
                       urban_nav_ros::toStatusMessage(node.stamp, source_, {node.status, 0, ""}, ""));
    before_ = node;
  }

 private:
  void writeTransforms(const Node& node, const Pose& T_map_base) {
    tf2_msgs::TFMessage message;
    if (map_.frame() == frames::kMap)
      message.transforms.push_back(
          stampedTransform(node.stamp, frames::kMap, frames::kOdom, T_map_base * node.T_odom_base.inverse()));
    message.transforms.push_back(stampedTransform(node.stamp, frames::kOdom, frames::kBaseLink, node.T_odom_base));
    recording_.write(topics::kTransforms, node.stamp, message);
  }

  const RecordedMap& map_;
  const StoredTrajectory& session_;
  const std::string source_;
  BagWriter& recording_;
  std::size_t next_ = 0;
  std::optional<Node> before_;
  const Matrix6d R_map_first_;  // turns covariances, which are in the axes of the first pose of the map
  std::map<urban_nav_core::StampNs, Matrix6d> relaxed_;
};

nav_msgs::Path wholePath(const RecordedMap& map) {
  urban_nav_core::TrajectorySegment all;
  for (const StoredTrajectory& session : map.sessions())
    for (const urban_nav_core::StampedPose& pose : session.T_map_base) all.poses.push_back({pose.stamp, pose.pose});
  nav_msgs::Path path = urban_nav_ros::toPathMessage(all, map.frame());
  path.header.stamp = urban_nav_ros::toRosTime(map.first());
  return path;
}

}  // namespace

void writePoseTopics(urban_nav_store::Store& store, const RecordedMap& map, BagWriter& recording) {
  recording.write(topics::results::kPath, map.first(), wholePath(map));
  for (const StoredTrajectory& session : map.sessions()) {
    std::vector<geometry_msgs::TransformStamped> mounted;
    for (const urban_nav_store::Extrinsic& sensor : store.sessions().extrinsics(session.session.id))
      mounted.push_back(urban_nav_ros::toStaticTransform(frames::kBaseLink, sensor.frame, sensor.T_base_frame));
    recording.writeStaticTransforms(session.T_map_base.front().stamp, mounted);
    SessionPoses poses(store, map, session, recording);
    store.graph().forEachNode(session.session.id, [&](const Node& node) { poses.add(node); });
  }
}

}  // namespace urban_nav
