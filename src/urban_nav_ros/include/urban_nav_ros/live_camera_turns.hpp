// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <optional>

#include "urban_nav_ros/stage_node.hpp"
#include "urban_nav_ros/topics.hpp"
#include "urban_nav_ros/turn_message.hpp"

namespace urban_nav_ros {

/// Corrects stereo pairs by the turns of the right camera that odometry publishes, for a stage that does not wait for
/// the odometry of each pair: the pair of the frame in which a turn is found may pass uncorrected. Thread-safe.
class LiveCameraTurns {
 public:
  /// Subscribes; odometry need not be present.
  template <typename Node>
  void subscribe(Node& node, int queue) {
    TopicOptions options;
    options.queue = queue;
    options.is_monitored = false;
    node.template subscribe<urban_nav_msgs::VoStatistics>(topics::kVoStatistics, options, [this](const auto& message) {
      const std::optional<urban_nav_core::StampedTurn> turn = toStampedTurn(*message);
      const std::lock_guard<std::mutex> lock(mutex_);
      if (turn && turns_) turns_->add(*turn);
    });
  }
  /// Begins a session of this camera.
  void begin(const urban_nav_core::StereoCamera& camera) {
    const std::lock_guard<std::mutex> lock(mutex_);
    turns_.emplace(camera);
  }
  void correct(urban_nav_core::StereoPairWithMotion& frame) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (turns_) turns_->correct(frame);
  }

 private:
  std::mutex mutex_;
  std::optional<urban_nav_core::RightCameraTurns> turns_;  // guarded by mutex_
};

}  // namespace urban_nav_ros
