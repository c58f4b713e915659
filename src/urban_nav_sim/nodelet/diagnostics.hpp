// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace urban_nav_sim {

/// Progress of the simulation.
struct Progress {
  std::string state;             ///< "running", "paused", ...
  double time = 0.0;             ///< s of the session
  std::optional<double> factor;  ///< s of the session per second of wall time
  bool slow = false;             ///< the machine is too slow for the requested rate
  std::int64_t messages = 0;     ///< published
};

/// /diagnostics of the nodelet. Thread-safe.
class Diagnostics {
 public:
  /// `session`: description of the session. `duration`: s. `rate`: requested rate.
  Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name, std::string session,
              double duration, double rate);

  void report(const Progress& progress);
  /// Publishes. Call about once per second of wall time.
  void update() { updater_.force_update(); }

 private:
  void fill(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  const std::string session_;
  const double duration_, rate_;
  mutable std::mutex mutex_;  // guards progress_
  Progress progress_;
  diagnostic_updater::Updater updater_;
};

}  // namespace urban_nav_sim
