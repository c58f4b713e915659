// SPDX-License-Identifier: BSD-3-Clause
#include "labels/class_images.hpp"

#include <sensor_msgs/Image.h>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

ClassImages::ClassImages(const rosbag::Bag& bag, const std::string& topic, const std::string& class_file) {
  if (topic.empty()) return;
  if (!class_file.empty()) map_ = scene_labeler::ClassMap(class_file);
  view_ = std::make_unique<rosbag::View>(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : *view_)
    if (const auto image = instance.instantiate<sensor_msgs::Image>())
      places_.emplace(std::pair(image->header.frame_id, urban_nav_ros::toStampNs(image->header.stamp)), instance);
  if (places_.empty())
    throw urban_nav_core::UserError("scene_labeler.class_topic", "no sensor_msgs/Image on " + topic,
                                    "a topic of the bag with mono8 class images");
}

cv::Mat ClassImages::at(const std::string& frame, urban_nav_core::StampNs stamp) const {
  const auto place = places_.find({frame, stamp});
  if (place == places_.end()) return {};
  const auto image = place->second.instantiate<sensor_msgs::Image>();
  if (!image || (image->encoding != "mono8" && image->encoding != "8UC1")) return {};
  return scene_labeler::toClassImage(urban_nav_ros::toGrey(*image).pixels, map_);
}

}  // namespace urban_nav
