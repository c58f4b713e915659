// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "heard_topics.hpp"
#include "localise_publisher.hpp"
#include "localise_worker.hpp"

namespace loop_metric {

/// /diagnostics of localisation, and its state as a whole: what is wrong first, then whether the robot is KNOWN, then figures and counts. Thread-safe.
class LocaliseDiagnostics {
 public:
  struct Counts {
    std::int64_t paused_dropped = 0;
    std::int64_t damaged = 0;          ///< odometry that is none
    std::int64_t beliefs_refused = 0;  ///< initial poses in another frame, or that are none
    bool paused = false;
  };

  /// `topics` must outlive it; `map`: the store's path.
  LocaliseDiagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name,
                      const HeardTopics& topics, std::string map);

  void worked(const LocaliseWorker::State& worker, const Counts& counts);
  urban_nav_core::Status status() const;
  /// Publishes; to be called about once a second, by the wall clock, so that a silent graph is reported too.
  void update() { updater_.force_update(); }

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  urban_nav_core::Status trouble() const;

  const HeardTopics& topics_;
  const std::string map_;
  mutable std::mutex mutex_;  // guards everything below but updater_
  LocaliseWorker::State worker_;
  Counts counts_;
  diagnostic_updater::Updater updater_;
};

}  // namespace loop_metric
