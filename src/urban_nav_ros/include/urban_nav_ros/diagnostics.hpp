// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include "urban_nav_core/types/status.hpp"

namespace urban_nav_ros {

/// Returns the level of diagnostic_msgs/DiagnosticStatus for a stage's health.
unsigned char toDiagnosticLevel(urban_nav_core::Health health);

/// Time of the last message on a topic, by the wall clock; detects missing publishers. Not thread-safe.
class Arrival {
 public:
  /// `name`: full name of the topic; empty: the topic is not used, and no fault is reported.
  explicit Arrival(std::string name = "") : name_(std::move(name)) {}

  void happen();
  const std::string& name() const { return name_; }
  bool any() const { return any_; }
  /// Returns the time since the last message, s; infinite without one.
  double age() const;
  /// Returns "/a/topic has not been received yet"; empty if it has been received or is not used.
  std::string absence() const;
  /// Returns "/a/topic has been silent for 12.0 s" if that is longer than `longest`, s; else empty.
  std::string silence(double longest) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  bool any_ = false;
  Clock::time_point when_;
};

}  // namespace urban_nav_ros
