// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "publisher.hpp"
#include "urban_nav_ros/diagnostics.hpp"
#include "worker.hpp"

namespace pose_graph {

/// /diagnostics of the nodelet: the state of the map first, then which topic is silent, then figures and counts.
/// Thread-safe.
class Diagnostics {
 public:
  /// What of a message's way went wrong before it reached the worker.
  struct Counts {
    std::int64_t paused_dropped = 0;
    std::int64_t damaged = 0;  ///< no pose, not finite, an unknown enumerator
  };

  Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name);

  /// A topic that is listened to, by its full name; `steady`: it is a fault when nothing comes.
  void expect(const std::string& topic, bool steady);
  void received(const std::string& topic);
  void relaxed(const urban_nav_core::Status& status, const std::string& reason_name, const Figures& figures);
  void worked(const Worker::Counts& worker, const Counts& counts);
  void stored(const StoreState& state);
  void refused(const std::string& why);
  void paused(bool paused);
  /// Publishes; to be called about once a second, by the wall clock, so that a silent graph is reported too.
  void update() { updater_.force_update(); }

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  std::string topicTrouble() const;

  mutable std::mutex mutex_;                                // guards everything below but updater_
  std::map<std::string, urban_nav_ros::Arrival> arrivals_;  // of steady topics
  urban_nav_core::Status status_;
  std::string reason_name_ = "None", refusal_;
  Figures figures_;
  StoreState store_;
  Worker::Counts worker_;
  Counts counts_;
  bool paused_ = false;
  diagnostic_updater::Updater updater_;
};

}  // namespace pose_graph
