// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>
#include <urban_nav_msgs/MetricClosure.h>

#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/pictures/cloud_picture.hpp"
#include "urban_nav_registration/pictures/match_picture.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace loop_metric {

using urban_nav_registration::CloudPictureOptions;
using urban_nav_registration::drawClouds;
using urban_nav_registration::drawMatches;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::MatchPictureOptions;
using urban_nav_registration::Picture;

namespace {

constexpr double kMetresPerRadian = 10.0;  // for the displayed covariance: typical distance of matched structures

std::string makeTitle(const urban_nav_core::PoseRef& at) {
  return (at.session.empty() ? "" : at.session + " ") + urban_nav_core::printStamp(at.stamp) + " s";
}

std::string makeSentence(const urban_nav_core::MetricClosure& closure) {
  return std::string(toString(closure.verdict)) + " (" + toString(closure.method) + "): " + closure.sentence;
}

Picture drawViews(const ClosureVerifier::Verdict& verdict) {
  const StereoAttempt& shown = verdict.attempts.stereo.back();
  MatchPictureOptions options;
  options.title_a = makeTitle(shown.keyframe_a.at);
  options.title_b = makeTitle(shown.keyframe_b.at);
  options.caption = makeSentence(verdict.metric);
  return drawMatches(verdict.keyframe(shown.keyframe_a.at), verdict.keyframe(shown.keyframe_b.at), shown.result.pixels,
                     options);
}

Picture drawAlignment(const ClosureVerifier::Verdict& verdict) {
  const urban_nav_core::PoseRef &a = verdict.metric.a, &b = verdict.metric.b;
  CloudPictureOptions options;
  options.free_directions = verdict.attempts.icp->free_directions;
  options.caption = "red: " + makeTitle(a) + "; blue: " + makeTitle(b) + "; " + makeSentence(verdict.metric);
  return drawClouds(verdict.cloud(b), verdict.cloud(a), verdict.attempts.icp_guess,
                    verdict.attempts.icp->T_target_source, options);
}

}  // namespace

Publisher::Publisher(ros::NodeHandle& nh, std::string base_frame)
    : base_frame_(std::move(base_frame)),
      metric_(nh.advertise<urban_nav_msgs::MetricClosure>(urban_nav_ros::topics::kMetricClosure, 1000)),
      matches_(nh.advertise<sensor_msgs::Image>(urban_nav_ros::topics::kClosureMatches, 5)) {}

void Publisher::publish(const ClosureVerifier::Verdict& verdict) {
  metric_.publish(urban_nav_ros::toMetricClosureMessage(verdict.metric, base_frame_, kMetresPerRadian));
  if (matches_.getNumSubscribers() > 0 && (verdict.attempts.icp || !verdict.attempts.stereo.empty()))
    publishPicture(verdict);
}

void Publisher::publishPicture(const ClosureVerifier::Verdict& verdict) {
  Picture picture;
  try {
    picture = verdict.attempts.icp ? drawAlignment(verdict) : drawViews(verdict);
  } catch (const urban_nav_core::Error&) {
    return;  // damaged in the store: stated in the verdict
  }
  sensor_msgs::Image message;
  message.header.stamp = urban_nav_ros::toRosTime(verdict.metric.b.stamp);
  message.header.frame_id = verdict.attempts.icp ? base_frame_ : kKeyframeCamera;
  message.width = static_cast<std::uint32_t>(picture.width);
  message.height = static_cast<std::uint32_t>(picture.height);
  message.encoding = sensor_msgs::image_encodings::BGR8;
  message.step = 3 * message.width;
  message.data = std::move(picture.bgr);
  matches_.publish(message);
}

}  // namespace loop_metric
