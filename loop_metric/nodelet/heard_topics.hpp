// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "urban_nav_ros/diagnostics.hpp"

namespace loop_metric {

/// The topics that a nodelet listens to, and which of them are silent. Thread-safe.
class HeardTopics {
 public:
  enum class Kind { Odometry, Images, Lasers, Closures, Beliefs };

  /// A topic that is listened to, by its full name.
  void expect(const std::string& topic, Kind kind);
  void received(const std::string& topic);
  /// "/a/topic has not come yet, /another has been silent for 12.0 s"; empty where all of this kind are heard.
  std::string silenceOf(Kind kind) const;

 private:
  struct Listened {
    Kind kind;
    urban_nav_ros::Arrival arrival;
  };
  mutable std::mutex mutex_;
  std::map<std::string, Listened> topics_;  // guarded by mutex_
};

}  // namespace loop_metric
