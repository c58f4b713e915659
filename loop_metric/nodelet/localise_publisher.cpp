// SPDX-License-Identifier: BSD-3-Clause
#include "localise_publisher.hpp"

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <urban_nav_msgs/Localisation.h>

#include "urban_nav_ros/path.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/status.hpp"

namespace loop_metric {

using urban_nav_msgs::Localisation;
using urban_nav_ros::toRosTime;

namespace {

std::uint8_t toMessage(Knowledge knowledge) {
  switch (knowledge) {
    case Knowledge::Unsure: return Localisation::UNSURE;
    case Knowledge::Known: return Localisation::KNOWN;
    case Knowledge::New: break;
  }
  return Localisation::NEW;
}

}  // namespace

const char* toString(LocaliseTrouble trouble) {
  switch (trouble) {
    case LocaliseTrouble::None: return "None";
    case LocaliseTrouble::NoOdometry: return "NoOdometry";
    case LocaliseTrouble::NoMap: return "NoMap";
    case LocaliseTrouble::NoCamera: return "NoCamera";
    case LocaliseTrouble::NoImages: return "NoImages";
    case LocaliseTrouble::ReadingMap: break;
  }
  return "ReadingMap";
}

LocalisePublisher::LocalisePublisher(ros::NodeHandle& nh, const LocalisationParameters& parameters)
    : parameters_(parameters),
      state_(nh.advertise<Localisation>("localisation/state", 100, true)),
      pose_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("localisation/pose", 100)),
      guess_(nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("localisation/guess", 100)),
      map_(nh.advertise<nav_msgs::Path>("localisation/map", 1, true)),
      status_(nh.advertise<urban_nav_msgs::StageStatus>("localisation/status", 10, true)),
      map_from_odom_(parameters.map_frame, parameters.odom_frame) {}

void LocalisePublisher::publish(const std::vector<urban_nav_store::StoredTrajectory>& map) {
  urban_nav_core::PoseRun drawn;
  for (const urban_nav_store::StoredTrajectory& session : map) {
    urban_nav_core::PoseRun run;
    for (const auto& [stamp, T_map_base] : session.T_map_base) run.poses.push_back({stamp, T_map_base});
    const urban_nav_core::PoseRun thin = urban_nav_ros::thinned(run, parameters_.path_spacing);
    drawn.poses.insert(drawn.poses.end(), thin.poses.begin(), thin.poses.end());
  }
  map_.publish(urban_nav_ros::toPathMessage(drawn, parameters_.map_frame));
}

void LocalisePublisher::publish(const Located& located, const std::optional<urban_nav_core::Pose>& T_map_odom) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.stamp = toRosTime(located.stamp);
  pose.header.frame_id = parameters_.map_frame;
  pose.pose.pose.orientation.w = 1.0;
  if (located.T_map_base) {
    pose.pose.pose = urban_nav_ros::toPoseMessage(located.T_map_base->pose);
    pose.pose.covariance = urban_nav_ros::toArray36(located.T_map_base->covariance);
    (located.knowledge == Knowledge::Known ? pose_ : guess_).publish(pose);
  }
  Localisation state;
  state.header = pose.header;
  state.knowledge = toMessage(located.knowledge);
  state.has_pose = located.T_map_base.has_value();
  state.T_map_base = pose.pose;
  state.witnesses = static_cast<std::uint32_t>(located.witnesses);
  state.probability = located.probability;
  state.reason = static_cast<int>(located.reason);
  state.reason_name = toString(located.reason);
  state.text = located.sentence;
  state_.publish(state);
  map_from_odom_.set(T_map_odom);
}

void LocalisePublisher::sendTransform(urban_nav_core::StampNs stamp) {
  if (parameters_.publish_tf) map_from_odom_.send(stamp);
}

void LocalisePublisher::publish(const urban_nav_core::Status& status) {
  const urban_nav_msgs::StageStatus message =
      urban_nav_ros::toStatusMessage(urban_nav_ros::toStampNs(ros::Time::now()), "localisation", status,
                                     toString(static_cast<LocaliseTrouble>(status.reason)));
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!last_.stage.empty() && message.status == last_.status && message.reason == last_.reason) return;
  last_ = message;
  status_.publish(message);
}

}  // namespace loop_metric
