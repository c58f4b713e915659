// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.hpp"

#include <cstdio>
#include <utility>

namespace urban_nav_sim {

using diagnostic_msgs::DiagnosticStatus;

namespace {

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name, std::string session,
                         double duration, double rate)
    : session_(std::move(session)), duration_(duration), rate_(rate), updater_(nh, private_nh, name) {
  progress_.state = "building the world";
  updater_.setHardwareID("simulated robot");
  updater_.add("simulation", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { fill(status); });
}

void Diagnostics::report(const Progress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  progress_ = progress;
}

void Diagnostics::fill(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (progress_.slow && progress_.factor)
    status.summary(DiagnosticStatus::WARN, progress_.state + " at " + rounded(*progress_.factor) +
                                               " times real time, not at " + rounded(rate_) +
                                               ": the machine does not render faster");
  else status.summary(DiagnosticStatus::OK, progress_.state);
  status.add("session", session_);
  status.add("state", progress_.state);
  status.add("time (s)", rounded(progress_.time));
  status.add("duration (s)", rounded(duration_));
  status.add("requested rate", rate_ > 0.0 ? rounded(rate_) : std::string("as fast as possible"));
  status.add("time factor", progress_.factor ? rounded(*progress_.factor) : std::string("not measured yet"));
  status.add("messages", progress_.messages);
}

}  // namespace urban_nav_sim
