// SPDX-License-Identifier: BSD-3-Clause
#include "recording/unused_topics.hpp"

#include <rosbag/view.h>

#include <map>
#include <utility>

namespace urban_nav_input {

namespace {

const std::set<std::string>& ownTopics() {
  static const std::set<std::string> names = {"rosout",          "rosout_agg", "clock",    "diagnostics",
                                              "diagnostics_agg", "tf",         "tf_static"};
  return names;
}

std::string bareTopic(const std::string& topic) {
  return !topic.empty() && topic.front() == '/' ? topic.substr(1) : topic;
}

}  // namespace

std::string describeUnusedTopics(std::list<rosbag::Bag>& bags, const std::set<std::string>& used) {
  std::map<std::string, std::pair<std::string, std::size_t>> unused;  // type and messages by name
  for (rosbag::Bag& bag : bags) {
    std::set<std::string> counted;
    for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
      const std::string& name = connection->topic;
      if (used.count(name) > 0 || ownTopics().count(bareTopic(name)) > 0 || !counted.insert(name).second) continue;
      std::pair<std::string, std::size_t>& entry = unused[name];
      entry.first = connection->datatype;
      entry.second += rosbag::View(bag, rosbag::TopicQuery(name)).size();
    }
  }
  std::string sentence;
  for (const auto& [name, entry] : unused)
    sentence += (sentence.empty() ? "not used: " : ", ") + name + " (" + entry.first + ", " +
                std::to_string(entry.second) + (entry.second == 1 ? " message)" : " messages)");
  return sentence;
}

}  // namespace urban_nav_input
