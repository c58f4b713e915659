// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace urban_nav_input {

/// Kinds of message members by size, on which alone serialization depends.
enum class FieldKind { Number1, Number2, Number4, Number8, Text, Time, Message };

/// Returns the size of a number, bytes; that of the seconds of a time, which is 4.
std::size_t numberSize(FieldKind kind);

/// Member of a message.
struct MessageField {
  enum class Array { None, Fixed, Sequence };
  std::string type;  ///< without array brackets and bounds: "float64", "geometry_msgs/Point"
  std::string name;
  FieldKind kind = FieldKind::Number1;
  Array array = Array::None;
  std::size_t count = 1;   ///< elements of a fixed array
  std::size_t layout = 0;  ///< index in MessageDefinition::layouts, if it is a message
};

/// Members of a message in their order.
struct MessageLayout {
  std::string type;  ///< "std_msgs/Header", as in ROS 1
  std::vector<MessageField> fields;
  std::vector<std::string> constants;  ///< "uint8 INT8=1", in the form hashed by ROS 1
};

/// Message with all nested messages.
struct MessageDefinition {
  std::vector<MessageLayout> layouts;  ///< the message itself is the first
};

/// Returns "sensor_msgs/Image" for "sensor_msgs/msg/Image"; any other name as it is.
std::string toRos1Type(const std::string& type);
/// Returns "sensor_msgs/msg/Image" for "sensor_msgs/Image"; a name with two slashes as it is.
std::string toRos2Type(const std::string& type);

/// Parses the definition of a type, followed by those of the types within it (ros1msg or ros2msg). Times of ROS 1
/// and of builtin_interfaces are the same kind. Throws std::invalid_argument naming the unsupported part.
MessageDefinition parseDefinition(const std::string& type, const std::string& text);

/// Returns the MD5 sum of a definition as computed by ROS 1, from the texts without comments.
std::string computeMd5(const MessageDefinition& definition);

/// Returns the text of a definition for ROS 1 or ROS 2: built-in types, names of types and members, and std_msgs/Header
/// are those of that version; comments are left out.
std::string printRos1(const MessageDefinition& definition);
std::string printRos2(const MessageDefinition& definition);

/// Return the definition with std_msgs/Header of ROS 1, with seq, or of ROS 2, without.
MessageDefinition withSequence(MessageDefinition definition);
MessageDefinition withoutSequence(MessageDefinition definition);

}  // namespace urban_nav_input
