// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <array>
#include <cstdint>
#include <mutex>
#include <string>

#include "swf_vo/frame.hpp"
#include "urban_nav_ros/diagnostics.hpp"

namespace swf_vo {

/// What the worker says of itself now and then.
struct Counts {
  std::int64_t frames = 0;
  std::int64_t sessions = 0;
  std::int64_t queue_dropped = 0;
  std::int64_t paused_dropped = 0;
  std::int64_t late = 0, doubled = 0;  ///< refused by the Inbox
  std::int64_t left_missing = 0, right_missing = 0;
  std::int64_t damaged = 0;  ///< images that do not decode or have a wrong size
};

/// /diagnostics of the nodelet: the top reason first, then which topic is missing or behind its partner, then the
/// counts. Thread-safe.
class Diagnostics {
 public:
  enum Topic { LeftImage, RightImage, LeftInfo, RightInfo, Motion, topic_count };

  Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name);

  /// A topic that is listened to, by its full name.
  void expect(Topic topic, const std::string& name);
  void received(Topic topic, urban_nav_core::StampNs stamp);
  void worked(const Frame& frame, double process_ms, const Counts& counts);
  /// Why there is no session; empty: there is.
  void waiting(const std::string& reason);
  void paused(bool paused);
  /// Publishes; to be called about once a second, by the wall clock, so that a silent graph is reported too.
  void update() { updater_.force_update(); }

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  std::string topicTrouble() const;

  mutable std::mutex mutex_;  // guards everything below but updater_
  std::array<urban_nav_ros::Arrival, topic_count> arrivals_;
  std::array<urban_nav_core::StampNs, topic_count> stamps_{};  // of the last ones
  Counts counts_;
  urban_nav_core::Status status_;
  Statistics statistics_;
  double process_ms_ = 0.0;
  std::string waiting_ = "no images yet";
  bool paused_ = false;
  diagnostic_updater::Updater updater_;
};

}  // namespace swf_vo
