// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/bag_fixes.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/NavSatFix.h>

#include <list>

#include "recording/bag_contents.hpp"
#include "recording/clock_steps.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/gps_reading.hpp"

namespace urban_nav_input {

namespace {

void placeAntenna(std::list<rosbag::Bag>& bags, const std::string& frame, BagFixes& fixes) {
  const urban_nav_ros::StaticTransforms transforms = readTransforms(bags);
  if (const auto T_base_gps = transforms.lookup(urban_nav_core::frames::kBaseLink, frame)) {
    fixes.p_base = T_base_gps->t();
    fixes.is_placed = true;
  }
}

}  // namespace

BagFixes readBagFixes(const std::vector<std::string>& paths, const std::vector<std::string>& topics) {
  BagFixes fixes;
  if (paths.empty() || inputKind(paths.front()) != InputKind::Bag) return fixes;
  try {
    std::list<rosbag::Bag> bags;
    for (const std::string& path : paths) bags.emplace_back(path, rosbag::bagmode::Read);
    const auto topic = chooseTopics(topicTypes(bags), topics).find(Role::Gps);
    if (!topic) return fixes;
    fixes.topic = topic->name;
    std::string frame;
    for (rosbag::Bag& bag : bags) {
      rosbag::View view(bag, rosbag::TopicQuery(topic->name));
      for (const rosbag::MessageInstance& instance : view) {
        const auto message = instance.instantiate<sensor_msgs::NavSatFix>();
        if (!message) continue;
        frame = message->header.frame_id;
        if (const auto reading = urban_nav_ros::toGpsReading(*message)) fixes.readings.push_back(*reading);
      }
    }
    if (!frame.empty()) placeAntenna(bags, frame, fixes);
  } catch (const rosbag::BagException& error) {
    throw urban_nav_core::DataError(paths.front(), std::string("is damaged: ") + error.what(), "");
  }
  return fixes;
}

}  // namespace urban_nav_input
