// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <urban_nav_msgs/LocalizationState.h>

#include "urban_nav_ros/path.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_localization {

using StateMessage = urban_nav_msgs::LocalizationState;
using urban_nav_ros::toRosTime;

namespace {

std::uint8_t toMessage(LocalizationState state) {
  switch (state) {
    case LocalizationState::Uncertain: return StateMessage::UNCERTAIN;
    case LocalizationState::Localized: return StateMessage::LOCALIZED;
    case LocalizationState::Unmapped: break;
  }
  return StateMessage::UNMAPPED;
}

}  // namespace

LocalizationPublisher::LocalizationPublisher(ros::NodeHandle& nh, const NodeletParameters& parameters)
    : parameters_(parameters),
      state_(nh.advertise<StateMessage>(urban_nav_ros::topics::kLocalizationState, 100, true)),
      pose_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>(urban_nav_ros::topics::kLocalizationPose, 100)),
      hypothesis_(
          nh.advertise<geometry_msgs::PoseWithCovarianceStamped>(urban_nav_ros::topics::kLocalizationHypothesis, 100)),
      map_path_(nh.advertise<nav_msgs::Path>(urban_nav_ros::topics::kLocalizationMapPath, 1, true)),
      map_from_odom_(parameters.map_frame, parameters.odom_frame) {}

void LocalizationPublisher::publish(const std::vector<urban_nav_store::StoredTrajectory>& map) {
  urban_nav_core::TrajectorySegment drawn;
  for (const urban_nav_store::StoredTrajectory& session : map) {
    urban_nav_core::TrajectorySegment run;
    for (const auto& [stamp, T_map_base] : session.T_map_base) run.poses.push_back({stamp, T_map_base});
    const urban_nav_core::TrajectorySegment thin = urban_nav_ros::thinned(run, parameters_.path_spacing);
    drawn.poses.insert(drawn.poses.end(), thin.poses.begin(), thin.poses.end());
  }
  map_path_.publish(urban_nav_ros::toPathMessage(drawn, parameters_.map_frame));
}

void LocalizationPublisher::publish(const LocalizationEstimate& estimate,
                                    const std::optional<urban_nav_core::Pose>& T_map_odom) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.stamp = toRosTime(estimate.stamp);
  pose.header.frame_id = parameters_.map_frame;
  pose.pose.pose.orientation.w = 1.0;
  if (estimate.T_map_base) {
    pose.pose.pose = urban_nav_ros::toPoseMessage(estimate.T_map_base->pose);
    pose.pose.covariance = urban_nav_ros::toArray36(estimate.T_map_base->covariance);
    (estimate.state == LocalizationState::Localized ? pose_ : hypothesis_).publish(pose);
  }
  StateMessage state;
  state.header = pose.header;
  state.state = toMessage(estimate.state);
  state.has_pose = estimate.T_map_base.has_value();
  state.T_map_base = pose.pose;
  state.supporting_matches = static_cast<std::uint32_t>(estimate.supporting_matches);
  state.probability = estimate.probability;
  state.reason = static_cast<int>(estimate.reason);
  state.reason_name = toString(estimate.reason);
  state.message = estimate.sentence;
  state_.publish(state);
  map_from_odom_.set(T_map_odom);
}

void LocalizationPublisher::sendTransform(urban_nav_core::StampNs stamp) {
  if (parameters_.publish_tf) map_from_odom_.send(stamp);
}

}  // namespace urban_nav_localization
