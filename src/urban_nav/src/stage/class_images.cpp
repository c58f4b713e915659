// SPDX-License-Identifier: BSD-3-Clause
#include "stage/class_images.hpp"

#include <sensor_msgs/Image.h>

#include "input/open.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

ClassImages::ClassImages(const std::vector<std::string>& inputs, const std::string& topic,
                         const std::string& class_file) {
  if (topic.empty()) return;
  if (!class_file.empty()) map_ = scene_labeler::ClassMap(class_file);
  for (const std::string& path : inputs) {
    if (inputKind(path) != InputKind::Bag) continue;
    try {
      const rosbag::Bag& bag = bags_.emplace_back(path, rosbag::bagmode::Read);
      for (const rosbag::MessageInstance& instance : views_.emplace_back(bag, rosbag::TopicQuery(topic)))
        if (const auto image = instance.instantiate<sensor_msgs::Image>())
          places_.emplace(std::pair(image->header.frame_id, urban_nav_ros::toStampNs(image->header.stamp)), instance);
    } catch (const rosbag::BagException& error) {
      throw urban_nav_core::DataError(path, std::string("cannot be read: ") + error.what(), "a whole bag");
    }
  }
}

cv::Mat ClassImages::at(const std::string& frame, urban_nav_core::StampNs stamp) const {
  const auto place = places_.find({frame, stamp});
  if (place == places_.end()) return {};
  const auto image = place->second.instantiate<sensor_msgs::Image>();
  if (!image || (image->encoding != "mono8" && image->encoding != "8UC1")) return {};
  return scene_labeler::toClassImage(urban_nav_ros::toGrey(*image).pixels, map_);
}

}  // namespace urban_nav
