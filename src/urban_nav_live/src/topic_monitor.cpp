// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/topic_monitor.hpp"

#include <cmath>
#include <cstdio>

namespace urban_nav_live {

namespace {

void append(const std::string& sentence, std::string& text) {
  if (!sentence.empty()) text += (text.empty() ? "" : ", ") + sentence;
}

std::string printSeconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f s", seconds);
  return text;
}

}  // namespace

void TopicMonitor::expect(const std::string& topic, double timeout, const std::string& group) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Topic monitored;
  monitored.group = group;
  monitored.timeout = timeout;
  topics_[topic] = monitored;
}

void TopicMonitor::expectPairs(const std::string& topic, const std::string& partner) {
  const std::lock_guard<std::mutex> lock(mutex_);
  pairs_.emplace_back(topic, partner);
}

void TopicMonitor::setIncomplete(bool incomplete) {
  const std::lock_guard<std::mutex> lock(mutex_);
  incomplete_ = incomplete;
}

void TopicMonitor::received(const std::string& topic, urban_nav_core::StampNs stamp) {
  const Clock::time_point now = now_();
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = topics_.find(topic);
  if (found == topics_.end()) return;
  found->second.any = true;
  found->second.when = now;
  found->second.stamp = stamp;
}

double TopicMonitor::age(const Topic& topic) const {
  return topic.any ? std::chrono::duration<double>(now_() - topic.when).count() : kNoTimeout;
}

std::string TopicMonitor::fault(const std::string& group) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string absent, silent;
  for (const auto& [name, topic] : topics_) {
    if (topic.group != group) continue;
    const double age = this->age(topic);
    if (!topic.any) append(name + " has not been received yet", absent);
    else if (age > topic.timeout) append(name + " has been silent for " + printSeconds(age), silent);
  }
  if (!absent.empty()) return absent;
  const std::string late = lateness(group);
  return late.empty() ? silent : late;
}

TopicMonitor::Fault TopicMonitor::worstFault(const std::string& group) const {
  constexpr double kLongSilence = 2.0;  // s
  Fault found{ReportLevel::Ok, fault(group)};
  if (found.sentence.empty()) return found;
  found.level = ReportLevel::Warning;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& [name, topic] : topics_)
    if (topic.group == group && topic.any && age(topic) > topic.timeout + kLongSilence)
      found.level = ReportLevel::Error;
  return found;
}

std::string TopicMonitor::lateness(const std::string& group) const {
  std::string text;
  for (const auto& [topic, partner] : pairs_) {
    auto late = topics_.find(topic), leader = topics_.find(partner);
    if (late == topics_.end() || leader == topics_.end() || late->second.group != group) continue;
    if (late->second.stamp > leader->second.stamp) std::swap(late, leader);
    const bool is_fault = incomplete_ || age(late->second) > late->second.timeout;
    const double lag_ms = 1e-6 * static_cast<double>(leader->second.stamp - late->second.stamp);
    if (!is_fault || !(lag_ms > 0.0) || !(age(leader->second) < leader->second.timeout)) continue;
    append(late->first + " lags " + leader->first + " by " + std::to_string(std::lround(lag_ms)) + " ms", text);
  }
  return text;
}

}  // namespace urban_nav_live
