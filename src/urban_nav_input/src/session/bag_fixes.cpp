// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/bag_fixes.hpp"

#include <sensor_msgs/NavSatFix.h>

#include <cmath>

#include "session/given_transforms.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/gps_reading.hpp"

namespace urban_nav_input {

namespace {

void placeAntenna(Recording& recording, const std::vector<std::string>& given, const std::string& frame,
                  BagFixes& fixes) {
  urban_nav_ros::StaticTransforms transforms = recording.transforms();
  giveTransforms(given, transforms);
  if (const auto T_base_gps = transforms.lookup(urban_nav_core::frames::kBaseLink, frame)) {
    fixes.p_base = T_base_gps->t();
    fixes.is_placed = true;
  }
}

}  // namespace

BagFixes readBagFixes(const std::vector<std::string>& paths, const std::vector<std::string>& topics,
                      const std::vector<std::string>& transforms, urban_nav_core::StampNs delay) {
  BagFixes fixes;
  if (paths.empty() || inputKind(paths.front()) != InputKind::Bag) return fixes;
  Recording recording(paths);
  const auto topic = chooseTopics(recording.topicTypes(), topics).find(Role::Gps);
  if (!topic) return fixes;
  fixes.topic = topic->name;
  std::string frame;
  RecordedMessages messages = recording.messages({topic->name});
  while (const std::optional<RecordedMessage> each = messages.next()) {
    const auto message = each->as<sensor_msgs::NavSatFix>();
    if (!message) continue;
    frame = message->header.frame_id;
    auto reading = urban_nav_ros::toGpsReading(*message);
    if (!reading) continue;
    reading->stamp -= delay;
    if (reading->stamp > 0) fixes.readings.push_back(*reading);
  }
  if (!frame.empty()) placeAntenna(recording, transforms, frame, fixes);
  return fixes;
}

}  // namespace urban_nav_input
