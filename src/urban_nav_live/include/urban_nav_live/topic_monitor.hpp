// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace urban_nav_live {

/// Monitors the arrival of messages on a stage's topics and reports those that are missing, silent or late. Uses the
/// machine's clock, so that a stopped simulated clock is reported too. Thread-safe.
class TopicMonitor {
 public:
  using Clock = std::chrono::steady_clock;
  using Now = std::function<Clock::time_point()>;
  static constexpr double kNoTimeout = std::numeric_limits<double>::infinity();

  explicit TopicMonitor(Now now = &Clock::now) : now_(std::move(now)) {}

  /// Monitors a topic by its full name. `timeout`: s without a message after which the topic is silent; kNoTimeout: one
  /// message is sufficient. `group`: key for fault().
  void expect(const std::string& topic, double timeout = kNoTimeout, const std::string& group = "");
  /// Declares that messages of two topics are paired, as stereo images are.
  void expectPairs(const std::string& topic, const std::string& partner);

  /// Records a message. Ignored for topics that are not monitored.
  void received(const std::string& topic, urban_nav_core::StampNs stamp = 0);
  /// Sets whether the newest pair lacked a partner. A lag is normal between two messages; in an incomplete pair it is a
  /// fault.
  void setIncomplete(bool incomplete);

  /// Returns the fault of a group's topics; empty: none. Topics never received come first ("/a has not been received
  /// yet, /b has not been received yet"), then a late partner ("/right lags /left by 40 ms"), then silent topics ("/a
  /// has been silent for 12.0 s"); only faults of the first such kind are returned.
  std::string fault(const std::string& group = "") const;
  /// Fault of a group's topics with its level: an error once a topic has been silent for 2 s, a fifth of the last 10 s,
  /// longer than its timeout.
  struct Fault {
    ReportLevel level = ReportLevel::Ok;
    std::string sentence;  ///< empty: no fault
  };
  Fault worstFault(const std::string& group = "") const;

 private:
  struct Topic {
    std::string group;
    double timeout = kNoTimeout;
    bool any = false;
    Clock::time_point when{};
    urban_nav_core::StampNs stamp = 0;
  };
  /// Returns the time since the newest message, s; infinite without one.
  double age(const Topic& topic) const;
  std::string lateness(const std::string& group) const;

  const Now now_;
  mutable std::mutex mutex_;
  std::map<std::string, Topic> topics_;                     // guarded by mutex_
  std::vector<std::pair<std::string, std::string>> pairs_;  // guarded by mutex_
  bool incomplete_ = false;                                 // guarded by mutex_
};

}  // namespace urban_nav_live
