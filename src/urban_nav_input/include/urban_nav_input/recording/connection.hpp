// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_input {

/// Stream of messages of one type on one topic, as declared in the file of a recording.
struct Connection {
  std::string topic;
  std::string type;                 ///< ROS 1 form for any storage: "sensor_msgs/Image"
  std::string md5;                  ///< MD5 sum of the definition as ROS 1 computes it; empty if unknown
  std::string definition;           ///< text with the definitions of all types within it; empty if the file has none
  std::string definition_encoding;  ///< "ros1msg", "ros2msg", or another one
  std::string encoding;             ///< "ros1", "cdr", or another one, of the messages
  std::string caller_id;            ///< node that published, if it is known
  bool is_latched = false;
};

}  // namespace urban_nav_input
