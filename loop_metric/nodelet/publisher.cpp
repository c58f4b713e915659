// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>
#include <urban_nav_msgs/MetricClosure.h>

#include <utility>

#include "loop_metric/cloud_picture.hpp"
#include "loop_metric/match_picture.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/status.hpp"

namespace loop_metric {

namespace {

constexpr double metres_per_radian = 10.0;  // of the covariance for display: what is matched is some ten metres away

std::string titleOf(const urban_nav_core::PoseRef& at) {
  return (at.session.empty() ? "" : at.session + " ") + urban_nav_core::printStamp(at.stamp) + " s";
}

std::string sentenceOf(const urban_nav_core::MetricClosure& closure) {
  return std::string(toString(closure.verdict)) + " (" + toString(closure.method) + "): " + closure.sentence;
}

Picture drawViews(const Judge::Verdict& verdict) {
  const StereoTry& shown = verdict.closure.stereo.back();
  MatchPictureOptions options;
  options.title_a = titleOf(shown.view_a.at);
  options.title_b = titleOf(shown.view_b.at);
  options.caption = sentenceOf(verdict.metric);
  return drawMatches(verdict.keyframe(shown.view_a.at), verdict.keyframe(shown.view_b.at), shown.result.pixels,
                     options);
}

Picture drawAlignment(const Judge::Verdict& verdict) {
  const urban_nav_core::PoseRef &a = verdict.closure.metric.a, &b = verdict.closure.metric.b;
  CloudPictureOptions options;
  options.free_directions = verdict.closure.icp->free_directions;
  options.caption = "red: " + titleOf(a) + "; blue: " + titleOf(b) + "; " + sentenceOf(verdict.metric);
  return drawClouds(verdict.cloud(b), verdict.cloud(a), verdict.closure.icp_guess, verdict.closure.icp->T_target_source,
                    options);
}

}  // namespace

const char* toString(Trouble trouble) {
  switch (trouble) {
    case Trouble::None: return "None";
    case Trouble::NoOdometry: return "NoOdometry";
    case Trouble::NotStored: return "NotStored";
    case Trouble::NoCamera: return "NoCamera";
    case Trouble::NoImages: return "NoImages";
    case Trouble::NoLasers: return "NoLasers";
    case Trouble::NoLaserPlace: break;
  }
  return "NoLaserPlace";
}

Publisher::Publisher(ros::NodeHandle& nh, std::string base_frame)
    : base_frame_(std::move(base_frame)),
      metric_(nh.advertise<urban_nav_msgs::MetricClosure>("loops/metric", 1000)),
      matches_(nh.advertise<sensor_msgs::Image>("loops/matches", 5)),
      status_(nh.advertise<urban_nav_msgs::StageStatus>("loop_metric/status", 10, true)) {}

void Publisher::publish(const Judge::Verdict& verdict) {
  metric_.publish(urban_nav_ros::toMetricClosureMessage(verdict.metric, base_frame_, metres_per_radian));
  if (matches_.getNumSubscribers() > 0 && (verdict.closure.icp || !verdict.closure.stereo.empty()))
    publishPicture(verdict);
}

void Publisher::publishPicture(const Judge::Verdict& verdict) {
  Picture picture;
  try {
    picture = verdict.closure.icp ? drawAlignment(verdict) : drawViews(verdict);
  } catch (const urban_nav_core::Error&) {
    return;  // damaged in the store: the verdict says so
  }
  sensor_msgs::Image message;
  message.header.stamp = urban_nav_ros::toRosTime(verdict.metric.b.stamp);
  message.header.frame_id = verdict.closure.icp ? base_frame_ : keyframe_camera;
  message.width = static_cast<std::uint32_t>(picture.width);
  message.height = static_cast<std::uint32_t>(picture.height);
  message.encoding = sensor_msgs::image_encodings::BGR8;
  message.step = 3 * message.width;
  message.data = std::move(picture.bgr);
  matches_.publish(message);
}

void Publisher::publish(const urban_nav_core::Status& status) {
  const urban_nav_msgs::StageStatus message = urban_nav_ros::toStatusMessage(
      urban_nav_ros::toStampNs(ros::Time::now()), "loop_metric", status, toString(static_cast<Trouble>(status.reason)));
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!last_.stage.empty() && message.status == last_.status && message.reason == last_.reason) return;
  last_ = message;
  status_.publish(message);
}

}  // namespace loop_metric
