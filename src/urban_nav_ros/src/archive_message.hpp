// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/serialization.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_ros {

/// Reads or writes a message in its serialised form. Throws DataError for truncated bytes.
template <typename Message>
void archiveMessage(urban_nav_core::Archive& archive, boost::shared_ptr<const Message>& message) {
  namespace wire = ros::serialization;
  std::vector<std::uint8_t> bytes;
  if (!archive.isReading()) {
    bytes.resize(wire::serializationLength(*message));
    wire::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    wire::serialize(stream, *message);
  }
  archive(bytes);
  if (!archive.isReading()) return;
  auto read = boost::make_shared<Message>();
  try {
    wire::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    wire::deserialize(stream, *read);
  } catch (const ros::Exception&) {
    archive.require(false, "a message is truncated");
  }
  message = read;
}

}  // namespace urban_nav_ros
