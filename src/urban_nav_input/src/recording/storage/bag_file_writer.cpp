// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/bag_file_writer.hpp"

#include <rosbag/bag.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "recording/message/serialized_message.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

void BagFileWriter::Close::operator()(rosbag::Bag* bag) const {
  try {
    bag->close();
  } catch (const rosbag::BagException&) {
    return;
  }
  delete bag;
}

BagFileWriter::BagFileWriter(const std::string& path) : path_(path), file_(path, ".active"), bag_(new rosbag::Bag) {
  try {
    bag_->open(file_.path(), rosbag::bagmode::Write);
    bag_->setCompression(rosbag::compression::Uncompressed);
  } catch (const rosbag::BagException& error) {
    fail(error);
  }
}

BagFileWriter::~BagFileWriter() = default;

void BagFileWriter::write(const Connection& connection, urban_nav_core::StampNs receipt, ByteView message) {
  boost::shared_ptr<ros::M_string> header;
  if (connection.is_latched || !connection.caller_id.empty()) {
    header = boost::make_shared<ros::M_string>();
    (*header)["type"] = connection.type;
    (*header)["md5sum"] = connection.md5;
    (*header)["message_definition"] = connection.definition;
    if (connection.is_latched) (*header)["latching"] = "1";
    if (!connection.caller_id.empty()) (*header)["callerid"] = connection.caller_id;
  }
  try {
    // rosbag does not accept a receipt at time zero; the stamp in the header is unchanged.
    bag_->write(connection.topic, std::max(ros::TIME_MIN, urban_nav_ros::toRosTime(receipt)),
                SerializedMessage{&connection, message}, header);
  } catch (const rosbag::BagException& error) {
    fail(error);
  }
}

std::uint64_t BagFileWriter::size() const { return bag_->getSize(); }

void BagFileWriter::commit() {
  try {
    bag_->close();
  } catch (const rosbag::BagException& error) {
    fail(error);
  }
  file_.commit();
}

void BagFileWriter::fail(const std::exception& error) const {
  throw urban_nav_core::UserError(path_, std::string("cannot be written: ") + error.what(), "");
}

}  // namespace urban_nav_input
