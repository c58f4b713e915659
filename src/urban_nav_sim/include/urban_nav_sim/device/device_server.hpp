// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav_sim {

/// Where the host finds a simulated device: a pseudo-terminal or a connection.
class DeviceLink {
 public:
  virtual ~DeviceLink() = default;
  virtual DeviceBytes read() = 0;
  /// Drops what does not fit, as a UART does.
  virtual void write(const DeviceBytes& bytes) = 0;
  /// Line rate that the host has set, bit/s.
  virtual int hostBaud() const = 0;
  /// Takes the device away, or brings it back under another name.
  virtual void setPlugged(bool plugged) = 0;
};

/// Pseudo-terminal with a symbolic link at `path`. Throws DataError naming it if that cannot be made.
std::unique_ptr<DeviceLink> openPseudoTerminal(const std::string& path);
/// TCP server for one client at a time at a port of this host; each is sent the greeting. Throws DataError.
std::unique_ptr<DeviceLink> openTcpServer(int port, const std::string& greeting);

/// Steady clock of serveDevice(), ns.
DeviceTime serverTime();

/// Runs a device in real time until its session ends or `stop` returns true. `begin`: of the session by the steady
/// clock, ns; before it the device is there and does not measure; nullopt: now. Returns the truth of all measurements,
/// by real time.
std::vector<DeviceTruth> serveDevice(SimulatedDevice& device, DeviceLink& link, const std::function<bool()>& stop,
                                     std::optional<DeviceTime> begin = {});

}  // namespace urban_nav_sim
