// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "scene_labeler/class_map.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// Class images by another source on a topic of a bag, found by frame and stamp of the image that they are of, wherever
/// they stand in the bag. Not thread-safe.
class ClassImages {
 public:
  /// Notes where the messages of `topic` are; empty: there are none. The bag must outlive it. Throws UserError if the
  /// bag has no sensor_msgs/Image on the topic, or the file of the map cannot be read.
  ClassImages(const rosbag::Bag& bag, const std::string& topic, const std::string& class_file);

  /// Returns the classes of an image (CV_8U, SceneClass); empty if there are none, or they are not mono8.
  cv::Mat at(const std::string& frame, urban_nav_core::StampNs stamp) const;
  /// Returns the number of class images.
  std::size_t size() const { return places_.size(); }

 private:
  scene_labeler::ClassMap map_;
  std::unique_ptr<rosbag::View> view_;  // that places_ lie in
  std::map<std::pair<std::string, urban_nav_core::StampNs>, rosbag::MessageInstance> places_;
};

}  // namespace urban_nav
