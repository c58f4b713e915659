// SPDX-License-Identifier: BSD-3-Clause
#include "convert/bag_writer.hpp"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;

void BagWriter::Close::operator()(rosbag::Bag* bag) const {
  try {
    bag->close();
  } catch (const rosbag::BagException&) {
    return;
  }
  delete bag;
}

BagWriter::BagWriter(const std::string& path) : path_(path), file_(path, ".active"), bag_(new rosbag::Bag) {
  try {
    bag_->open(file_.path(), rosbag::bagmode::Write);
    bag_->setCompression(rosbag::compression::Uncompressed);
  } catch (const rosbag::BagException& error) {
    fail(error);
  }
}

BagWriter::~BagWriter() = default;

void BagWriter::writeStaticTransforms(StampNs stamp, const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  for (geometry_msgs::TransformStamped& transform : message.transforms)
    transform.header.stamp = urban_nav_ros::toRosTime(stamp);
  const auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype(message);
  (*header)["md5sum"] = ros::message_traits::md5sum(message);
  (*header)["message_definition"] = ros::message_traits::definition(message);
  (*header)["latching"] = "1";
  (*header)["callerid"] = "/urban_nav_convert";
  writeNow(urban_nav_ros::topics::kStaticTransforms, stamp, message, header);
}

void BagWriter::commit() {
  try {
    bag_->close();
  } catch (const rosbag::BagException& error) {
    fail(error);
  }
  file_.commit();
}

/// rosbag refuses a receipt at time zero; the stamp in the header stays what it is.
ros::Time BagWriter::receipt(StampNs stamp) const { return std::max(ros::TIME_MIN, urban_nav_ros::toRosTime(stamp)); }

void BagWriter::fail(const std::exception& error) const {
  throw urban_nav_core::UserError(path_, std::string("cannot be written: ") + error.what(), "");
}

}  // namespace urban_nav
