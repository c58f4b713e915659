// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"

namespace fabmap_node {

/// Selects the images of one camera at keyframes (urban_nav_registration::KeyframeSelector), which are the places of a
/// robot without panoramas, live as offline. Images and poses with equal stamps belong together; either may arrive
/// first, and frames without a pose are left out. Not thread-safe.
template <typename Image>
class KeyframeImages {
 public:
  using StampNs = urban_nav_core::StampNs;
  struct Keyframe {
    StampNs stamp = 0;
    Image image;
  };

  /// `patience`: keyframes are held until the images span this time, ns, so that the caller can drop this camera when
  /// another source of images appears.
  KeyframeImages(const urban_nav_registration::Parameters& parameters, StampNs patience)
      : parameters_(parameters), patience_(patience), selector_(parameters) {}

  /// Adds an image; stamps increase until restart().
  void addImage(StampNs stamp, Image image) {
    if (!first_image_) first_image_ = stamp;
    images_.push_back({stamp, std::move(image)});
    if (images_.size() > kMostWaiting) images_.pop_front();
    match();
  }
  /// Adds a pose of odometry. Stamps that jump back belong to the images after restart().
  void addPose(const urban_nav_core::StampedPose& T_odom_base) {
    if (newest_pose_ && urban_nav_core::jumpsBack(T_odom_base.stamp, *newest_pose_)) {
      if (are_images_ahead_) poses_.clear();
      else next_round_ = poses_.size();
      are_images_ahead_ = false;
    }
    newest_pose_ = T_odom_base.stamp;
    poses_.push_back(T_odom_base);
    if (poses_.size() > kMostWaiting) {
      poses_.pop_front();
      if (next_round_ && *next_round_ > 0) --*next_round_;
    }
    match();
  }
  /// Begins the next round after the stamps of the images have jumped back.
  void restart() {
    are_images_ahead_ = !next_round_ && newest_pose_;
    const std::size_t ended = next_round_.value_or(poses_.size());
    poses_.erase(poses_.begin(), poses_.begin() + static_cast<std::ptrdiff_t>(ended));
    next_round_.reset();
    images_.clear();
    first_image_.reset();
    selector_ = urban_nav_registration::KeyframeSelector(parameters_);
  }

  /// Returns the oldest keyframe that has not been taken; nullopt without one, or during `patience`. `all`: does not
  /// wait for the end of it.
  std::optional<Keyframe> take(bool all = false) {
    if (keyframes_.empty() || (!all && !is_patience_over_)) return std::nullopt;
    Keyframe taken = std::move(keyframes_.front());
    keyframes_.pop_front();
    return taken;
  }
  /// Returns true once images have spanned `patience`.
  bool isPatienceOver() const { return is_patience_over_; }

 private:
  static constexpr std::size_t kMostWaiting = 64;  // frames: 3 s of a camera at 20 Hz

  /// Returns the poses that belong to the images.
  std::size_t posesInRound() const { return are_images_ahead_ ? 0 : next_round_.value_or(poses_.size()); }
  void match() {
    if (first_image_ && !images_.empty() && images_.back().stamp - *first_image_ >= patience_) is_patience_over_ = true;
    while (posesInRound() > 0 && !images_.empty()) {
      const urban_nav_core::StampedPose& pose = poses_.front();
      while (!images_.empty() && images_.front().stamp < pose.stamp) images_.pop_front();
      if (images_.empty()) return;
      if (images_.front().stamp == pose.stamp) {
        if (selector_.select(pose.pose)) {
          keyframes_.push_back(std::move(images_.front()));
          if (keyframes_.size() > kMostWaiting) keyframes_.pop_front();
        }
        images_.pop_front();
      }
      poses_.pop_front();
      if (next_round_) --*next_round_;
    }
  }

  const urban_nav_registration::Parameters parameters_;
  const StampNs patience_;
  urban_nav_registration::KeyframeSelector selector_;
  std::deque<Keyframe> images_;  // without a pose yet
  std::deque<urban_nav_core::StampedPose> poses_;  // without an image yet
  std::optional<std::size_t> next_round_;          // index of the first pose of the next round
  std::deque<Keyframe> keyframes_;
  std::optional<StampNs> first_image_, newest_pose_;
  bool are_images_ahead_ = false;  // stamps of images have jumped back, those of poses have not
  bool is_patience_over_ = false;
};

}  // namespace fabmap_node
