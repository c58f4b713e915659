// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/cloud_messages.hpp"

#include <sensor_msgs/PointCloud2.h>

#include <stdexcept>
#include <utility>

#include "recording/message/transcoder.hpp"
#include "urban_nav_core/laser/cloud/livox.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/connection_definition.hpp"
#include "urban_nav_input/recording/message_encoding.hpp"
#include "urban_nav_ros/cloud_view.hpp"

namespace urban_nav_input {

CloudMessages::CloudMessages() = default;
CloudMessages::CloudMessages(CloudMessages&&) noexcept = default;
CloudMessages& CloudMessages::operator=(CloudMessages&&) noexcept = default;
CloudMessages::~CloudMessages() = default;

std::optional<CloudMessages::Cloud> CloudMessages::read(const RecordedMessage& message) {
  std::optional<Cloud> cloud;
  if (isLivoxType(message.connection().type)) {
    cloud = readLivox(message);
  } else if (const auto points = message.as<sensor_msgs::PointCloud2>()) {
    cloud = Cloud{points->header.frame_id, urban_nav_ros::toCloudView(*points)};
    owner_ = points;
  }
  if (cloud && cloud->view.stamp == 0) cloud->view.stamp = message.receipt();
  return cloud;
}

std::optional<CloudMessages::Cloud> CloudMessages::readLivox(const RecordedMessage& message) {
  const Connection& connection = message.connection();
  const ByteView bytes = message.bytes();
  if (bytes.data == nullptr) return std::nullopt;
  const std::optional<MessageEncoding> encoding =
      connection.encoding == "ros1" ? std::optional<MessageEncoding>(MessageEncoding::Ros1) : cdrEncoding(bytes);
  if (!encoding) return std::nullopt;
  const std::string key = connection.type + connection.definition;
  try {
    if (transcoders_.find(key) == transcoders_.end()) {
      std::unique_ptr<Transcoder> transcoder;
      const std::string package = connection.type.substr(0, connection.type.find('/'));
      if (!connection.definition.empty())
        transcoder = std::make_unique<Transcoder>(
            findDefinition(connection), parseDefinition(connection.type, urban_nav_core::livoxDefinition(package)));
      transcoders_[key] = transcoder && !transcoder->isSame() ? std::move(transcoder) : nullptr;
    }
    ByteView packed = bytes;
    auto form = *encoding == MessageEncoding::Ros1           ? urban_nav_core::LivoxEncoding::Ros1
                : *encoding == MessageEncoding::CdrBigEndian ? urban_nav_core::LivoxEncoding::CdrBigEndian
                                                             : urban_nav_core::LivoxEncoding::Cdr;
    if (Transcoder* transcoder = transcoders_[key].get()) {
      packed = transcoder->convert(bytes, *encoding, MessageEncoding::Ros1);
      form = urban_nav_core::LivoxEncoding::Ros1;
    }
    bytes_.assign(packed.data, packed.data + packed.size);
    auto cloud = urban_nav_core::parseLivox(bytes_.data(), bytes_.size(), form);
    if (!cloud) return std::nullopt;
    return Cloud{std::move(cloud->frame), std::move(cloud->view)};
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // another definition with the same name
  } catch (const std::runtime_error&) {
    return std::nullopt;  // the bytes end before the message
  }
}

}  // namespace urban_nav_input
