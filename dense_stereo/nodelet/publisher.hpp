// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dense_stereo/near_scene.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"
#include "urban_nav_ros/stage_node.hpp"

namespace dense_stereo {

/// Publishes scenes: topics and types of stereo_image_proc, ground plane and obstacles. Used by one thread.
class Publisher {
 public:
  /// `node` must outlive this object.
  explicit Publisher(urban_nav_ros::StageNode& node);

  /// Begins a session: frame and camera for the messages.
  void startSession(const std::string& frame, const urban_nav_core::StereoCamera& camera, int disparities);
  /// Returns whether any topic has a subscriber.
  bool isWanted() const;
  void publish(const NearScene& scene, const urban_nav_core::StereoPair& pair);

 private:
  urban_nav_ros::StageNode& node_;
  ros::Publisher disparity_, points_, ground_, obstacles_;
  std::string frame_;
  urban_nav_core::StereoCamera camera_;
  int disparities_ = 0;
};

}  // namespace dense_stereo
