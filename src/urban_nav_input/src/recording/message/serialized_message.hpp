// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstdint>
#include <cstring>

#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/connection.hpp"

namespace urban_nav_input {

/// Message of any type for librosbag and publishers of roscpp. Both members must outlive it.
struct SerializedMessage {
  const Connection* connection;
  ByteView bytes;
};

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
