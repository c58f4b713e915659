// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/recording_writer.hpp"

namespace urban_nav {

/// Writes a recording atomically: MCAP if its path ends in ".mcap", else a bag with uncompressed chunks. Requires
/// messages in the order of receipt. Throws UserError naming the file if it cannot be written.
class BagWriter {
 public:
  explicit BagWriter(const std::string& path);
  ~BagWriter();

  template <typename Message>
  void write(const std::string& topic, urban_nav_core::StampNs stamp, const Message& message) {
    writeNow(topic, stamp, message, false);
  }
  /// /tf_static, latched.
  void writeStaticTransforms(urban_nav_core::StampNs stamp,
                             const std::vector<geometry_msgs::TransformStamped>& transforms);

  /// Closes, flushes, renames.
  void commit();
  /// Returns the number of messages so far by topic.
  const std::map<std::string, std::int64_t>& counts() const { return counts_; }

 private:
  template <typename Message>
  void writeNow(const std::string& topic, urban_nav_core::StampNs stamp, const Message& message, bool is_latched);

  std::unique_ptr<urban_nav_input::RecordingWriter> writer_;
  std::map<std::pair<std::string, std::string>, urban_nav_input::Connection> connections_;  // key: topic and type
  std::vector<std::uint8_t> bytes_;  // buffer of the current message
  std::map<std::string, std::int64_t> counts_;
};

template <typename Message>
void BagWriter::writeNow(const std::string& topic, urban_nav_core::StampNs stamp, const Message& message,
                         bool is_latched) {
  namespace traits = ros::message_traits;
  const auto [known, is_new] = connections_.try_emplace({topic, traits::DataType<Message>::value()});
  urban_nav_input::Connection& connection = known->second;
  if (is_new) {
    connection.topic = topic;
    connection.type = traits::DataType<Message>::value();
    connection.md5 = traits::MD5Sum<Message>::value();
    connection.definition = traits::Definition<Message>::value();
    connection.definition_encoding = "ros1msg";
    connection.encoding = "ros1";
    connection.is_latched = is_latched;
    if (is_latched) connection.caller_id = "/urban_nav_convert";
  }
  bytes_.resize(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes_.data(), static_cast<std::uint32_t>(bytes_.size()));
  ros::serialization::serialize(stream, message);
  writer_->write(connection, stamp, {bytes_.data(), bytes_.size()});
  ++counts_[topic];
}

}  // namespace urban_nav
