// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.hpp"

#include <algorithm>

namespace pose_graph {

using diagnostic_msgs::DiagnosticStatus;

namespace {

// s; a filter with a window gives its first settled pose so late, and later ones at the rate of its images.
constexpr double silent_after = 5.0;

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name)
    : updater_(nh, private_nh, name) {
  updater_.setHardwareID("none");
  updater_.add("map", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
}

void Diagnostics::expect(const std::string& topic, bool steady) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (steady) arrivals_.emplace(topic, urban_nav_ros::Arrival(topic));
}

void Diagnostics::received(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto found = arrivals_.find(topic); found != arrivals_.end()) found->second.happen();
}

void Diagnostics::relaxed(const urban_nav_core::Status& status, const std::string& reason_name,
                          const Figures& figures) {
  const std::lock_guard<std::mutex> lock(mutex_);
  status_ = status;
  reason_name_ = reason_name;
  figures_ = figures;
}

void Diagnostics::worked(const Worker::Counts& worker, const Counts& counts) {
  const std::lock_guard<std::mutex> lock(mutex_);
  worker_ = worker;
  counts_ = counts;
}

void Diagnostics::stored(const StoreState& state) {
  const std::lock_guard<std::mutex> lock(mutex_);
  store_ = state;
}

void Diagnostics::refused(const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  refusal_ = why;
}

void Diagnostics::paused(bool paused) {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = paused;
}

std::string Diagnostics::topicTrouble() const {
  for (const auto& [name, arrival] : arrivals_)
    for (const std::string& trouble : {arrival.absence(), arrival.silence(silent_after)})
      if (!trouble.empty()) return trouble;
  return {};
}

void Diagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string trouble = topicTrouble();
  if (paused_) {
    status.summary(DiagnosticStatus::OK, "paused");
  } else {
    std::string text = status_.sentence.empty() ? toString(status_.health) : status_.sentence;
    if (!trouble.empty()) text += ": " + trouble;
    if (!store_.fault.empty()) text += "; not stored: " + store_.fault;
    const unsigned char at_least = !store_.fault.empty() ? DiagnosticStatus::ERROR
                                   : trouble.empty()     ? DiagnosticStatus::OK
                                                         : DiagnosticStatus::WARN;
    status.summary(std::max(urban_nav_ros::diagnosticLevelOf(status_.health), at_least), text);
  }
  status.add("status", std::string(toString(status_.health)));
  status.add("reason", reason_name_);
  status.add("revision", figures_.revision);
  status.add("sessions", figures_.sessions);
  status.add("sessions joined to this one", figures_.sessions_joined);
  status.add("poses", figures_.poses);
  status.add("closures", figures_.closures);
  status.add("closures rejected", figures_.closures_rejected);
  status.add("closures that wait for a second one", figures_.closures_waiting);
  status.add("time of the last relaxation (ms)", figures_.relax_ms);
  status.add("relaxations", worker_.relaxations);
  status.add("dropped: queue full", worker_.dropped);
  status.add("dropped: paused", counts_.paused_dropped);
  status.add("refused", worker_.refused);
  status.add("refused last", refusal_);
  status.add("messages damaged", counts_.damaged);
  status.add("store", store_.path);
  if (store_.path.empty()) return;
  status.add("store: writes committed", store_.committed);
  status.add("store: writes that wait", store_.waiting);
  status.add("store: writes refused", store_.refused);
  status.add("store: evidence lost", store_.lost);
  status.add("store: fault", store_.fault);
}

}  // namespace pose_graph
