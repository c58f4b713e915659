// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stage_node.hpp"

#include <ros/console.h>
#include <ros/this_node.h>

#include <algorithm>
#include <thread>

#include "urban_nav_core/io/printable.hpp"
#include "urban_nav_ros/status.hpp"

namespace urban_nav_ros {

using urban_nav_core::printable;

namespace {

constexpr std::chrono::seconds kWarningPeriod{5};

}  // namespace

StageNode::StageNode(Handles handles, const std::string& stage, const std::string& topic)
    : handles_(std::move(handles)),
      stage_(stage),
      sensors_(handles_.nh),
      status_publisher_(handles_.nh.advertise<urban_nav_msgs::StageStatus>(stage + "/status", 10, true)),
      updater_(handles_.nh, handles_.private_nh, handles_.name) {
  updater_.setHardwareID("none");
  updater_.add(topic, [this](diagnostic_updater::DiagnosticStatusWrapper& status) { fill(status); });
}

void StageNode::publishStatus(const urban_nav_core::Status& status, const std::string& reason_name,
                              urban_nav_core::StampNs stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const urban_nav_msgs::StageStatus message = toStatusMessage(stamp, stage_, status, reason_name);
  if (last_status_ && last_status_->status == message.status && last_status_->reason == message.reason) return;
  last_status_ = message;
  status_publisher_.publish(message);
}

void StageNode::restartStatus() {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_status_.reset();
}

void StageNode::setReport(urban_nav_live::StageReport report, std::int64_t dropped, std::int64_t pushed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  report_ = std::move(report);
  dropped_ = dropped;
  pushed_ = pushed;
}

void StageNode::fill(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const urban_nav_live::InputGate::Counts counts = gate_.counts();
  std::vector<urban_nav_live::StageReport::FaultCount> faults = report_.fault_counts;
  faults.push_back({"inputs were dropped", dropped_, pushed_,
                    "the stage is slower than its inputs; lower their rate, or free processor time"});
  faults.push_back({"messages were damaged", counts.invalid, counts.received,
                    "they are not finite or have an unknown enumerator; the log names the topic"});
  rates_.add(faults);
  const auto [rate_level, rate_sentence] = rates_.summary();
  const urban_nav_live::TopicMonitor::Fault topics = monitor_.worstFault();
  urban_nav_live::StageReport report = report_;
  for (const std::string& fault : sensors_.faults()) report.warn(fault);
  auto [level, summary] = urban_nav_live::summarise(report, gate_.isPaused(), topics.sentence, topics.level);
  if (!rate_sentence.empty() && !gate_.isPaused()) {
    level = std::max(level, rate_level);
    summary += "; " + rate_sentence;
  }
  status.summary(static_cast<unsigned char>(level), summary);
  status.add("status", std::string(toString(report_.status.health)));
  status.add("reason", report_.reason_name);
  for (const auto& figure : report_.figures) status.add(figure.name, figure.value);
  status.add("dropped: queue full", dropped_);
  status.add("dropped: paused", counts.paused_dropped);
  status.add("messages damaged", counts.invalid);
}

void StageNode::logInfo(const std::string& text) const {
  ROS_INFO("%s: %s", handles_.name.c_str(), printable(text).c_str());
}

void StageNode::logError(const std::string& text) const {
  ROS_ERROR("%s: %s", handles_.name.c_str(), printable(text).c_str());
}

bool StageNode::followStore(const urban_nav_live::StoreState& state) {
  if (state.fault == store_fault_) return false;
  if (state.fault.empty()) logInfo(state.path + ": store is writable again");
  else logError("store: " + state.fault);
  store_fault_ = state.fault;
  return true;
}

void StageNode::logWarning(const std::string& key, const std::string& text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto [entry, is_new] = warned_.emplace(key, Clock::now());
    if (!is_new && Clock::now() - entry->second < kWarningPeriod) return;
    entry->second = Clock::now();
  }
  ROS_WARN("%s: %s", handles_.name.c_str(), printable(text).c_str());
}

void StageNode::awaitInputs(std::chrono::steady_clock::time_point end) const {
  constexpr std::chrono::milliseconds kPoll{20}, kQuiet{300};
  if (awaited_.empty()) return;
  ros::V_string own;  // stages of this process have finished already
  ros::this_node::getAdvertisedTopics(own);
  const auto is_over = [&own](const ros::Subscriber& topic) {
    return topic.getNumPublishers() == 0 || std::find(own.begin(), own.end(), topic.getTopic()) != own.end();
  };
  std::int64_t received = -1;
  Clock::time_point changed = Clock::now();
  while (Clock::now() < end) {
    const std::int64_t now = gate_.counts().received;
    if (now != received) changed = Clock::now();
    received = now;
    if (Clock::now() - changed >= kQuiet && std::all_of(awaited_.begin(), awaited_.end(), is_over)) return;
    // Sensors may continue: their messages have no effect once the awaited topics have ended.
    if (std::all_of(awaited_.begin(), awaited_.end(), [](const auto& topic) { return topic.getNumPublishers() == 0; }))
      return;
    std::this_thread::sleep_for(kPoll);
  }
}

void StageNode::unsubscribe(const std::string& topic) {
  const std::string name = handles_.nh.resolveName(topic);
  const std::lock_guard<std::mutex> lock(subscribers_mutex_);
  for (ros::Subscriber& each : subscribers_)
    if (each && each.getTopic() == name) each.shutdown();
}

void StageNode::shutDown() {
  std::vector<ros::Subscriber> ended;  // whose callbacks may run until it is destroyed
  {
    const std::lock_guard<std::mutex> lock(subscribers_mutex_);
    ended.swap(subscribers_);
  }
  ended.clear();
  awaited_.clear();
  services_.clear();
}

}  // namespace urban_nav_ros
