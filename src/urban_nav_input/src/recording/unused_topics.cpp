// SPDX-License-Identifier: BSD-3-Clause
#include "recording/unused_topics.hpp"

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

std::string describeUnusedTopics(Recording& recording, const std::set<std::string>& used) {
  std::map<std::string, std::pair<std::string, std::size_t>> unused;  // type and messages by name
  for (const auto& [name, type] : recording.topicTypes())
    if (used.count(name) == 0 && ownTopics().count(bareTopic(name)) == 0) unused[name] = {type, recording.count(name)};
  std::string sentence;
  for (const auto& [name, entry] : unused)
    sentence += (sentence.empty() ? "not used: " : ", ") + name + " (" + entry.first + ", " +
                std::to_string(entry.second) + (entry.second == 1 ? " message)" : " messages)");
  return sentence;
}

}  // namespace urban_nav_input
