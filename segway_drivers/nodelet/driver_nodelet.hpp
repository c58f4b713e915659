// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nodelet/nodelet.h>
#include <ros/publisher.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "device_diagnostics.hpp"
#include "live/nodelet_parameters.hpp"
#include "live/work_queue.hpp"
#include "segway_drivers/driver/run_device.hpp"
#include "segway_drivers/transport/host_clock.hpp"

namespace segway_drivers {

/// Nodelet of a driver. One thread reads, ticks and writes on the steady clock and never waits for ROS; another
/// publishes. Publishes /diagnostics once per second. The port may be missing at the start and may disappear.
class DriverNodelet : public nodelet::Nodelet {
 public:
  ~DriverNodelet() override;

 protected:
  /// Ends both threads. Must be called by the destructor of the derived class, whose members the threads use.
  void shutDown();
  /// Advertises topics and makes the driver, whose callbacks publish(). Errors are fatal.
  virtual std::unique_ptr<DriverCore> makeDriver(const Parameters& parameters) = 0;
  /// Prefix of the device's rows in the table, such as "lms291".
  virtual std::string device() const = 0;
  /// Called by the reading thread before each step.
  virtual void beforeStep(TimeNs /*now*/) {}
  /// Adds device-specific rows of the diagnostics; called under lock() by the thread of ROS.
  virtual void addDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& /*status*/) {}

  const NodeletParameters& nodelet() const { return nodelet_; }
  std::string frameOr(const std::string& otherwise) const {
    return nodelet_.frame.empty() ? otherwise : nodelet_.frame;
  }
  /// Returns the ROS time of a steady time. For callbacks of the driver.
  ros::Time toRos(TimeNs steady) const;
  /// Queues work for the publishing thread. For callbacks of the driver.
  void publish(std::function<void()> work) { queue_.push(std::move(work)); }
  /// Publishes raw arrival and device time on time_reference.
  void publishTimeReference(const std::string& frame, TimeNs arrival, double device_s);
  std::mutex& lock() { return mutex_; }

 private:
  void onInit() final;
  void run();
  void addRows(DeviceDiagnostics::Status& status);
  void takeSnapshot(const std::string& remark);

  NodeletParameters nodelet_;
  Parameters parameters_;
  std::unique_ptr<DriverCore> driver_;
  HostClock clock_;
  ros::Publisher time_reference_;
  DeviceDiagnostics diagnostics_;
  WorkQueue queue_;
  std::thread reader_, publisher_;
  std::atomic<bool> stop_{false};

  std::mutex mutex_;  // guards the following members
  std::string remark_, last_warning_;
  double offset_s_ = 0.0, skew_ppm_ = 0.0, sigma_us_ = 0.0, excess_ms_ = 0.0;
  bool has_clock_ = false;
};

}  // namespace segway_drivers
