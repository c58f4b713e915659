// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "scene_labeler/class_map.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav {

/// Class images from another source on a topic of bags, accessed by frame and stamp of the classified image,
/// independent of their order in the bags. Not thread-safe.
class ClassImages {
 public:
  /// Opens the bags among the inputs and indexes the messages of `topic`; an empty topic means none. Throws UserError
  /// if the class map cannot be read, DataError if a bag cannot be read.
  ClassImages(const std::vector<std::string>& inputs, const std::string& topic, const std::string& class_file);

  /// Returns the classes of an image (CV_8U, SceneClass); empty if there are none, or they are not mono8.
  cv::Mat at(const std::string& frame, urban_nav_core::StampNs stamp) const;
  /// Returns the number of class images.
  std::size_t size() const { return places_.size(); }

 private:
  scene_labeler::ClassMap map_;
  std::list<urban_nav_input::Recording> recordings_;
  std::list<urban_nav_input::RecordedMessages> messages_;  // storage of places_
  std::map<std::pair<std::string, urban_nav_core::StampNs>, urban_nav_input::RecordedMessage> places_;
};

}  // namespace urban_nav
