// SPDX-License-Identifier: BSD-3-Clause
#include "views.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "loop_metric/stored_surroundings.hpp"
#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/camera_info.hpp"

namespace loop_metric {

using urban_nav_core::StampNs;
using urban_nav_ros::Side;
using urban_nav_ros::StereoFeed;

namespace {

// Five seconds at 20 Hz: odometry that is further behind has dropped frames. 40 MB at 512x384.
constexpr std::size_t most_pairs = 100;
constexpr std::size_t most_view_poses = 1000;

StampNs nanoseconds(double seconds) { return static_cast<StampNs>(std::llround(seconds * 1e9)); }

bool sameCalibration(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  return a.width == b.width && a.height == b.height && a.D == b.D && a.K == b.K && a.R == b.R && a.P == b.P;
}

}  // namespace

Views::Views(const Parameters& parameters, const ListeningParameters& listening, bool rectified, std::string where,
             const urban_nav_ros::StaticTransforms& transforms)
    : parameters_(parameters),
      listening_(listening),
      rectified_(rectified),
      where_(std::move(where)),
      transforms_(transforms),
      choice_(parameters) {}

void Views::add(Side side, const sensor_msgs::CameraInfoConstPtr& info) {
  sensor_msgs::CameraInfoConstPtr& known = side == Side::Left ? left_info_ : right_info_;
  if (known && sameCalibration(*known, *info)) return;
  // A new left camera with the old right one would be neither: the other side has to speak again.
  if (known) (side == Side::Left ? right_info_ : left_info_).reset();
  known = info;
  fault_.clear();
  camera_.reset();
  feed_.reset();
  pairs_.clear();
}

bool Views::add(const ImageInput& image) {
  const bool back = newest_image_ && urban_nav_core::jumpsBack(image.stamp, *newest_image_);
  if (back) forgetTime();
  newest_image_ = back || !newest_image_ ? image.stamp : std::max(*newest_image_, image.stamp);
  if (!first_image_) first_image_ = Clock::now();
  if (!camera_) tryToStart();
  if (!feed_) {
    before_.push_back(image);
    if (before_.size() > 2 * most_pairs) before_.pop_front();
    return back;
  }
  for (const ImageInput& each : std::exchange(before_, {}))
    std::visit([&](const auto& message) { feed_->add(each.side, message); }, each.message);
  std::visit([&](const auto& message) { feed_->add(image.side, message); }, image.message);
  return back;
}

void Views::forgetTime() {
  before_.clear();
  pairs_.clear();
  odometry_.clear();
  newest_pose_.reset();
  choice_ = KeyframeChoice(parameters_);
  if (calibration_ && feed_) begin();
}

void Views::tryToStart() {
  if (!left_info_ || !right_info_ || !fault_.empty()) return;
  const std::string& frame = left_info_->header.frame_id;
  const auto T_base_camera = transforms_.lookup(listening_.base_frame, frame);
  if (!T_base_camera && Clock::now() - *first_image_ < std::chrono::duration<double>(listening_.tf_wait)) return;
  try {
    calibration_ = std::make_shared<urban_nav_ros::StereoCalibration>(
        urban_nav_ros::toCameraInfo(*left_info_), urban_nav_ros::toCameraInfo(*right_info_), rectified_, where_);
  } catch (const urban_nav_core::UserError& error) {
    fault_ = error.what();
    return;
  }
  camera_ = {calibration_->camera(),
             T_base_camera.value_or(urban_nav_ros::opticalInBody()) * calibration_->T_optical_rectified()};
  note_ = T_base_camera ? ""
                        : "no static tf from " + listening_.base_frame + " to " + frame + ": " + listening_.base_frame +
                              " is taken to be at the left camera (REP-103 axes)";
  maker_.emplace(camera_->camera, parameters_.points);
  begin();
}

void Views::begin() {
  StereoFeed::Options options;
  options.max_lateness = nanoseconds(listening_.max_lateness);
  options.pairing_tolerance = nanoseconds(listening_.pairing);
  options.delivery = urban_nav_core::DeliveryOrder::OrderedStreams;
  feed_.emplace(options, calibration_);
}

void Views::hear(const urban_nav_core::StampedPose& odometry) {
  if (newest_pose_ && odometry.stamp <= *newest_pose_) {
    if (!urban_nav_core::jumpsBack(odometry.stamp, *newest_pose_)) return;
    odometry_.clear();
  }
  newest_pose_ = odometry.stamp;
  odometry_.push_back(odometry);
  if (odometry_.size() > most_view_poses) odometry_.pop_front();
}

std::vector<urban_nav_store::StoredKeyframe> Views::take() {
  std::vector<urban_nav_store::StoredKeyframe> kept;
  while (auto pair = feed_ ? feed_->take() : std::nullopt) {
    ++counts_.pairs;
    counts_.damaged += static_cast<std::int64_t>(pair->faults.size());
    pairs_.push_back(std::move(*pair));
    if (pairs_.size() <= most_pairs) continue;
    pairs_.pop_front();
    ++counts_.unplaced;
  }
  while (!pairs_.empty() && !odometry_.empty()) {
    const urban_nav_core::StereoPair& pair = pairs_.front().assembled.pair;
    const urban_nav_core::StampedPose& here = odometry_.front();
    if (pair.stamp == here.stamp && !pair.left.empty() && !pair.right.empty() && choice_.choose(here.pose)) {
      kept.push_back(storedKeyframe(maker_->make({"", pair.stamp}, pair)));
      ++counts_.kept;
    }
    const StampNs stamp = pair.stamp, heard = here.stamp;
    if (stamp < heard) ++counts_.unplaced;
    if (stamp <= heard) pairs_.pop_front();
    if (heard <= stamp) odometry_.pop_front();
  }
  return kept;
}

}  // namespace loop_metric
