// SPDX-License-Identifier: BSD-3-Clause
#include "heard_topics.hpp"

namespace loop_metric {

namespace {

// s; a filter with a window gives its first settled pose so late, and later ones at the rate of its images.
constexpr double silent_after = 5.0;

}  // namespace

void HeardTopics::expect(const std::string& topic, Kind kind) {
  const std::lock_guard<std::mutex> lock(mutex_);
  topics_.insert_or_assign(topic, Listened{kind, urban_nav_ros::Arrival(topic)});
}

void HeardTopics::received(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto found = topics_.find(topic); found != topics_.end()) found->second.arrival.happen();
}

std::string HeardTopics::silenceOf(Kind kind) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string words;
  for (const auto& [name, topic] : topics_) {
    if (topic.kind != kind) continue;
    std::string silence = topic.arrival.absence();
    if (silence.empty()) silence = topic.arrival.silence(silent_after);
    if (!silence.empty()) words += (words.empty() ? "" : ", ") + silence;
  }
  return words;
}

}  // namespace loop_metric
