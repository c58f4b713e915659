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

/// Arrivals on the topics of a stage, and sentences for those that are absent, silent or late. The clock is the
/// machine's, so that a graph whose simulated time stands still is reported too. Thread-safe.
class TopicMonitor {
 public:
  using Clock = std::chrono::steady_clock;
  using Now = std::function<Clock::time_point()>;
  static constexpr double kNoTimeout = std::numeric_limits<double>::infinity();

  explicit TopicMonitor(Now now = &Clock::now) : now_(std::move(now)) {}

  /// Monitors a topic by its full name. `timeout`: s without a message until the topic is silent; kNoTimeout: it need
  /// only arrive once. `group`: a word by which faults are asked for.
  void expect(const std::string& topic, double timeout = kNoTimeout, const std::string& group = "");
  /// Declares that messages of two topics come in pairs, as stereo images do.
  void expectPairs(const std::string& topic, const std::string& partner);

  /// Records a message. Ignored for topics that are not monitored.
  void received(const std::string& topic, urban_nav_core::StampNs stamp = 0);
  /// States whether the newest pair lacked a partner. A lag is normal between two messages; in an incomplete pair it is
  /// a fault.
  void setIncomplete(bool incomplete);

  /// Returns what is wrong with the topics of a group; empty: nothing. Topics that have not arrived come first ("/a has
  /// not come yet, /b has not come yet"), then a late partner ("/right lags /left by 40 ms"), then silent topics ("/a
  /// has been silent for 12.0 s"); only the first kind of fault is returned.
  std::string fault(const std::string& group = "") const;
  /// Fault of the topics of a group with its level: an error once a topic has been silent for 2 s longer
  /// than its timeout, a fifth of the last 10 s.
  struct Fault {
    ReportLevel level = ReportLevel::Ok;
    std::string sentence;  ///< empty: nothing
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
  /// Since the newest message, s; infinite if there was none.
  double age(const Topic& topic) const;
  std::string lateness(const std::string& group) const;

  const Now now_;
  mutable std::mutex mutex_;
  std::map<std::string, Topic> topics_;                     // guarded by mutex_
  std::vector<std::pair<std::string, std::string>> pairs_;  // guarded by mutex_
  bool incomplete_ = false;                                 // guarded by mutex_
};

}  // namespace urban_nav_live
