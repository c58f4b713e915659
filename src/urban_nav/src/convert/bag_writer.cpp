// SPDX-License-Identifier: BSD-3-Clause
#include "convert/bag_writer.hpp"

#include <tf2_msgs/TFMessage.h>

#include <filesystem>

#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;

BagWriter::BagWriter(const std::string& path)
    : writer_(std::filesystem::path(path).extension() == ".mcap" ? urban_nav_input::createRecording(path)
                                                                 : urban_nav_input::createBag(path)) {}

BagWriter::~BagWriter() = default;

void BagWriter::writeStaticTransforms(StampNs stamp, const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  for (geometry_msgs::TransformStamped& transform : message.transforms)
    transform.header.stamp = urban_nav_ros::toRosTime(stamp);
  writeNow(urban_nav_ros::topics::kStaticTransforms, stamp, message, true);
}

void BagWriter::commit() { writer_->commit(); }

}  // namespace urban_nav
