// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "segway_drivers/driver/driver_core.hpp"

namespace segway_drivers {

/// Contents of the diagnostics of every device.
struct DeviceSnapshot {
  DriverState state = DriverState::Absent;
  std::string identity;
  std::string reason;  ///< of a state other than streaming
  DeviceCounters counters;
};

/// Publishes the state of a device on /diagnostics once per second. set() may be called in any thread.
class DeviceDiagnostics {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  /// `nh`, `private_nh`, `name`: of the nodelet. `more`: adds device-specific rows; called in a thread of ROS until
  /// stop().
  void start(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& name,
             const std::string& hardware, const std::string& port, std::function<void(Status&)> more);
  void stop() { timer_.stop(); }
  void set(DeviceSnapshot snapshot);
  DeviceSnapshot get() const;

 private:
  void fill(Status& status) const;

  std::string port_;
  std::function<void(Status&)> more_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::WallTimer timer_;
  mutable std::mutex mutex_;  // guards the following members
  DeviceSnapshot snapshot_;
};

}  // namespace segway_drivers
