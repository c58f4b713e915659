// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <list>
#include <string>

namespace urban_nav_input {

/// Returns the first message of a topic that is of type Message; null if there is none. Throws rosbag::BagException.
template <typename Message>
boost::shared_ptr<Message> firstMessage(std::list<rosbag::Bag>& bags, const std::string& topic) {
  for (rosbag::Bag& bag : bags) {
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& instance : view)
      if (boost::shared_ptr<Message> message = instance.instantiate<Message>()) return message;
  }
  return nullptr;
}

}  // namespace urban_nav_input
