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
  /// `node` must outlive this object. `view_interval`: time between samples for the map, s.
  Publisher(urban_nav_ros::StageNode& node, double view_interval);

  /// Begins a session: frame and camera for the messages.
  void startSession(const std::string& frame, const urban_nav_core::StereoCamera& camera, int disparities);
  /// Returns whether a topic has a subscriber; that of the samples for the map only once in their interval.
  bool isWanted(urban_nav_core::StampNs stamp) const;
  void publish(const NearScene& scene, const urban_nav_core::StereoPair& pair);

 private:
  bool isViewDue(urban_nav_core::StampNs stamp) const;

  urban_nav_ros::StageNode& node_;
  const urban_nav_core::StampNs view_interval_;
  ros::Publisher disparity_, points_, ground_, obstacles_, view_;
  urban_nav_core::StampNs last_view_ = 0;
  std::string frame_;
  urban_nav_core::StereoCamera camera_;
  int disparities_ = 0;
};

}  // namespace dense_stereo
