// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/class_images.hpp"

#include <sensor_msgs/Image.h>

#include <algorithm>
#include <array>

#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

ClassImages::ClassImages(const std::vector<std::string>& inputs, const std::string& topic,
                         const std::string& class_file) {
  if (topic.empty()) return;
  if (!class_file.empty()) map_ = scene_labeler::ClassMap(class_file);
  for (const std::string& path : inputs) {
    if (urban_nav_input::inputKind(path) != urban_nav_input::InputKind::Bag) continue;
    urban_nav_input::Recording& recording = recordings_.emplace_back(path);
    urban_nav_input::RecordedMessages& messages = messages_.emplace_back(recording.messages({topic}));
    while (const auto message = messages.next())
      if (const auto image = message->as<sensor_msgs::Image>())
        places_.emplace(std::pair(image->header.frame_id, urban_nav_ros::toStampNs(image->header.stamp)), *message);
  }
}

cv::Mat ClassImages::at(const std::string& frame, urban_nav_core::StampNs stamp) const {
  const auto place = places_.find({frame, stamp});
  if (place == places_.end()) return {};
  const auto image = place->second.as<sensor_msgs::Image>();
  constexpr std::array<const char*, 4> kEncodings = {"mono8", "8UC1", "mono16", "16UC1"};
  if (!image || std::find(kEncodings.begin(), kEncodings.end(), image->encoding) == kEncodings.end()) return {};
  return scene_labeler::toClassImage(urban_nav_ros::toGrey(*image, urban_nav_ros::kPixelsAsStored).pixels, map_);
}

}  // namespace urban_nav
