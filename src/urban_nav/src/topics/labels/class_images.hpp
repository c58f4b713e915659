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

/// Class images by another source on a topic of bags, found by frame and stamp of the image that they are of, wherever
/// they stand in the bags. Not thread-safe.
class ClassImages {
 public:
  /// Opens those inputs that are bags and notes where the messages of `topic` are; an empty topic: there are none.
  /// Throws UserError if the file of the map cannot be read, DataError if a bag cannot.
  ClassImages(const std::vector<std::string>& inputs, const std::string& topic, const std::string& class_file);

  /// Returns the classes of an image (CV_8U, SceneClass); empty if there are none, or they are not mono8.
  cv::Mat at(const std::string& frame, urban_nav_core::StampNs stamp) const;
  /// Returns the number of class images.
  std::size_t size() const { return places_.size(); }

 private:
  scene_labeler::ClassMap map_;
  std::list<urban_nav_input::Recording> recordings_;
  std::list<urban_nav_input::RecordedMessages> messages_;  // that places_ lie in
  std::map<std::pair<std::string, urban_nav_core::StampNs>, urban_nav_input::RecordedMessage> places_;
};

}  // namespace urban_nav
