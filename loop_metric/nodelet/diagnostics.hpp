// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "heard_topics.hpp"
#include "publisher.hpp"
#include "recorder.hpp"

namespace loop_metric {

/// /diagnostics of the nodelet, and the state of the stage as a whole: what is wrong first, then which topic is silent, then figures and counts.
/// Thread-safe.
class Diagnostics {
 public:
  struct Counts {
    std::int64_t candidates = 0;
    std::int64_t paused_dropped = 0;
    std::int64_t damaged = 0;  ///< not finite, no pose, a probability outside 0...1
  };

  /// `clouds`: lasers are wanted. `topics` must outlive it.
  Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name, const HeardTopics& topics,
              bool views, bool clouds);

  void judged(const urban_nav_core::MetricClosure& closure, double ms);
  void worked(const Recorder::State& recorder, const Judge::Counts& judge, const StoreState& store,
              const Counts& counts);
  void paused(bool paused);
  urban_nav_core::Status status() const;
  /// Publishes; to be called about once a second, by the wall clock, so that a silent graph is reported too.
  void update() { updater_.force_update(); }

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  urban_nav_core::Status trouble() const;

  const HeardTopics& topics_;
  const bool views_, clouds_;
  mutable std::mutex mutex_;  // guards everything below but updater_
  Recorder::State recorder_;
  Judge::Counts judge_;
  StoreState store_;
  Counts counts_;
  std::string last_verdict_;
  double last_ms_ = 0.0;
  bool paused_ = false;
  diagnostic_updater::Updater updater_;
};

}  // namespace loop_metric
