// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_live/stage_report.hpp"

namespace urban_nav_live {

/// Fault rates over the last ten seconds, from monotonic counters. Not thread-safe.
class FaultRates {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kWindow{10};
  static constexpr double kWarning = 0.01, kError = 0.2;  ///< shares above which a warning or an error is reported

  explicit FaultRates(std::function<Clock::time_point()> now = &Clock::now) : now_(std::move(now)) {}

  /// Adds the present counts; call about once a second. A counter that decreases is treated as restarted.
  void add(const std::vector<StageReport::FaultCount>& counts);
  /// Returns the level of the largest share, and a message for each that is a warning or an error: "26 % of the pairs
  /// were dropped in the last 10 s: lower the rate of the camera". Empty: no fault.
  std::pair<ReportLevel, std::string> summary() const;

 private:
  struct Sample {
    Clock::time_point when;
    std::int64_t faults = 0, total = 0;
  };
  struct Kind {
    std::string advice;
    std::deque<Sample> samples;  // oldest first; the first is the newest before the window
  };
  const std::function<Clock::time_point()> now_;
  std::map<std::string, Kind> kinds_;  // by FaultCount::what
};

}  // namespace urban_nav_live
