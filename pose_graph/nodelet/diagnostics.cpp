// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.hpp"

#include <algorithm>
#include <cmath>

namespace pose_graph {

using diagnostic_msgs::DiagnosticStatus;
using urban_nav_core::Health;

namespace {

// s; a filter with a window gives its first settled pose so late, and later ones at the rate of its images.
constexpr double silent_after = 5.0;

unsigned char levelOf(Health health) {
  switch (health) {
    case Health::Ok:
    case Health::Recovered: return DiagnosticStatus::OK;
    case Health::Degraded: return DiagnosticStatus::WARN;
    case Health::Lost: return DiagnosticStatus::ERROR;
  }
  return DiagnosticStatus::ERROR;
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name)
    : updater_(nh, private_nh, name) {
  updater_.setHardwareID("none");
  updater_.add("map", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
}

void Diagnostics::expect(const std::string& topic, bool steady) {
  const std::lock_guard<std::mutex> lock(mutex_);
  arrivals_[topic].steady = steady;
}

void Diagnostics::received(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Arrival& arrival = arrivals_[topic];
  arrival.any = true;
  arrival.when = Clock::now();
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
  for (const auto& [name, arrival] : arrivals_) {
    if (!arrival.steady) continue;
    if (!arrival.any) return name + " has not come yet";
    const double age = std::chrono::duration<double>(Clock::now() - arrival.when).count();
    if (age > silent_after) return name + " has been silent for " + std::to_string(std::lround(age)) + " s";
  }
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
    status.summary(std::max(levelOf(status_.health), at_least), text);
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
