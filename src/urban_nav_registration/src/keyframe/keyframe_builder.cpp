// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe_builder.hpp"

namespace urban_nav_registration {

using urban_nav_core::StampedPose;
using urban_nav_core::StampNs;

namespace {

// Five seconds at 20 Hz; with a longer delay odometry has dropped frames. 40 MB at 512x384.
constexpr std::size_t kMaxPairs = 100;
constexpr std::size_t kMaxPoses = 1000;

}  // namespace

void KeyframeBuilder::setCamera(const MountedCamera& camera) {
  pairs_.clear();
  camera_ = camera;
  extractor_.emplace(camera.camera, parameters_.points);
  turns_.emplace(camera.camera);
}

void KeyframeBuilder::clearCamera() {
  pairs_.clear();
  camera_.reset();
  extractor_.reset();
  turns_.reset();
}

void KeyframeBuilder::restart() {
  pairs_.clear();
  if (camera_) turns_.emplace(camera_->camera);
  restartOdometry();
  selector_ = KeyframeSelector(parameters_);
}

void KeyframeBuilder::addPair(urban_nav_core::StereoPairWithMotion pair) {
  ++counts_.pairs;
  pairs_.push_back(std::move(pair));
  if (pairs_.size() <= kMaxPairs) return;
  pairs_.pop_front();
  ++counts_.without_odometry;
}

void KeyframeBuilder::restartOdometry() {
  odometry_.clear();
  newest_pose_.reset();
}

void KeyframeBuilder::addOdometry(const StampedPose& T_odom_base) {
  if (newest_pose_ && T_odom_base.stamp <= *newest_pose_) return;
  newest_pose_ = T_odom_base.stamp;
  odometry_.push_back(T_odom_base);
  if (odometry_.size() > kMaxPoses) odometry_.pop_front();
}

void KeyframeBuilder::addTurn(const urban_nav_core::StampedTurn& turn) {
  if (turns_) turns_->add(turn);
}

std::vector<Keyframe> KeyframeBuilder::take() {
  std::vector<Keyframe> taken;
  while (!pairs_.empty() && !odometry_.empty()) {
    const urban_nav_core::StereoPair& pair = pairs_.front().pair;
    const StampedPose& pose = odometry_.front();
    if (pair.stamp == pose.stamp && !pair.left.empty() && !pair.right.empty() && selector_.select(pose.pose)) {
      turns_->correct(pairs_.front());
      taken.push_back(extractor_->extract({"", pair.stamp}, pair));
      ++counts_.extracted;
    }
    const StampNs pair_stamp = pair.stamp, pose_stamp = pose.stamp;
    if (pair_stamp < pose_stamp) ++counts_.without_odometry;
    if (pair_stamp <= pose_stamp) pairs_.pop_front();
    if (pose_stamp <= pair_stamp) odometry_.pop_front();
  }
  return taken;
}

}  // namespace urban_nav_registration
