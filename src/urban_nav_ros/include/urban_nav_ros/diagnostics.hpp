// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include "urban_nav_core/types/status.hpp"

namespace urban_nav_ros {

/// The level of diagnostic_msgs/DiagnosticStatus at which a stage's health is reported.
unsigned char toDiagnosticLevel(urban_nav_core::Health health);

/// When a topic was received last, by the wall clock: detects a silent graph. Not thread-safe.
class Arrival {
 public:
  /// `name`: the topic's full name; empty: it is not listened to, and nothing is wrong with it.
  explicit Arrival(std::string name = "") : name_(std::move(name)) {}

  void happen();
  const std::string& name() const { return name_; }
  bool any() const { return any_; }
  /// Since the last one, s; infinite where there was none.
  double age() const;
  /// "/a/topic has not come yet"; empty where it has, or need not.
  std::string absence() const;
  /// "/a/topic has been silent for 12.0 s", where that is longer than this (s).
  std::string silence(double longest) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  bool any_ = false;
  Clock::time_point when_;
};

}  // namespace urban_nav_ros
