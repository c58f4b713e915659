// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/diagnostics.hpp"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstdio>
#include <limits>

namespace urban_nav_ros {

using diagnostic_msgs::DiagnosticStatus;
using urban_nav_core::Health;

unsigned char toDiagnosticLevel(Health health) {
  switch (health) {
    case Health::Ok:
    case Health::Recovered: return DiagnosticStatus::OK;
    case Health::Degraded: return DiagnosticStatus::WARN;
    case Health::Lost: return DiagnosticStatus::ERROR;
  }
  return DiagnosticStatus::ERROR;
}

void Arrival::happen() {
  any_ = true;
  when_ = Clock::now();
}

double Arrival::age() const {
  return any_ ? std::chrono::duration<double>(Clock::now() - when_).count() : std::numeric_limits<double>::infinity();
}

std::string Arrival::absence() const { return name_.empty() || any_ ? "" : name_ + " has not been received yet"; }

std::string Arrival::silence(double longest) const {
  const double age = this->age();
  if (name_.empty() || !any_ || !(age > longest)) return {};
  char seconds[32];
  std::snprintf(seconds, sizeof(seconds), "%.1f s", age);
  return name_ + " has been silent for " + seconds;
}

}  // namespace urban_nav_ros
