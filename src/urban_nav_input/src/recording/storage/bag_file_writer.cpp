// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/bag_file_writer.hpp"

#include <rosbag/bag.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

namespace {

/// Message as librosbag takes it.
struct SerializedMessage {
  const Connection* connection;
  ByteView bytes;
};

}  // namespace

}  // namespace urban_nav_input

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<urban_nav_input::SerializedMessage> {
  static const char* value(const urban_nav_input::SerializedMessage& message) {
    return message.connection->md5.c_str();
  }
};
template <>
struct DataType<urban_nav_input::SerializedMessage> {
  static const char* value(const urban_nav_input::SerializedMessage& message) {
    return message.connection->type.c_str();
  }
};
template <>
struct Definition<urban_nav_input::SerializedMessage> {
  static const char* value(const urban_nav_input::SerializedMessage& message) {
    return message.connection->definition.c_str();
  }
};

}  // namespace message_traits
namespace serialization {

template <>
struct Serializer<urban_nav_input::SerializedMessage> {
  template <typename Stream>
  static void write(Stream& stream, const urban_nav_input::SerializedMessage& message) {
    if (message.bytes.size > 0)
      std::memcpy(stream.advance(serializedLength(message)), message.bytes.data, message.bytes.size);
  }
  static std::uint32_t serializedLength(const urban_nav_input::SerializedMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size);
  }
};

}  // namespace serialization
}  // namespace ros

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
    // rosbag refuses a receipt at time zero; the stamp in the header stays what it is.
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
