// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "segway_drivers/driver/driver_core.hpp"
#include "segway_drivers/parameters.hpp"
#include "segway_drivers/segway_rmp/command_guard.hpp"
#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

/// Opens a device: a path of a serial port, HOST:PORT of a TCP server, or a CAN interface such as can0 or vcan0.
std::unique_ptr<Port> openPort(const std::string& name, std::string& error);

/// Runs a DriverCore on a port: reads, ticks, writes, reopens with increasing pauses. A call of step() takes at most
/// `wait`. Not thread-safe.
class DriverLoop {
 public:
  DriverLoop(DriverCore& core, std::string port);

  /// Opens the port for the first time. Throws DataError with its name on failure.
  void open();
  /// Waits up to `wait` ns for bytes and performs due actions.
  void step(TimeNs wait);
  bool isOpen() const { return port_ != nullptr; }
  const std::string& remark() const { return remark_; }

 private:
  void act();
  void lose(TimeNs now);
  void tryOpen(TimeNs now);

  DriverCore& core_;
  std::string name_, remark_;
  std::unique_ptr<Port> port_;
  TimeNs pause_ = 0, next_try_ = 0;
};

/// A velocity command of a drive file.
struct DriveWish {
  TimeNs time = 0;  ///< ns since the port was opened
  RmpCommand wish;
};
/// Reads `t_s,linear_mps,angular_radps`. Throws UserError with file and line.
std::vector<DriveWish> readDriveFile(const std::string& path);
/// A device to run without ROS, and the file of its measurements.
struct RunJob {
  std::string kind;  ///< lms291, xsens_mti, segway_rmp, gps
  std::string port;
  double duration = 0;  ///< s
  std::string output;   ///< CSV as written by decode
  std::string drive;    ///< file of velocity commands for segway_rmp, or empty
};
/// Counters and clock of a device at the end of a run.
struct RunResult {
  DeviceCounters counters;
  std::string state, identity;
  double offset_s = 0.0, skew_ppm = 0.0, sigma_us = 0.0;
};

/// Runs a driver without ROS and writes its messages with stamps of real time; messages before the first clock estimate
/// are omitted. `report` receives events. Throws UserError, and DataError if the port is missing at the start.
RunResult runDevice(const RunJob& job, const Parameters& parameters,
                    const std::function<void(const DriverEvent&)>& report);

}  // namespace segway_drivers
