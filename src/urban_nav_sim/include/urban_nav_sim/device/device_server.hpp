// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav_sim {

/// Connection of the host to a simulated device: a pseudo-terminal or a socket.
class DeviceLink {
 public:
  virtual ~DeviceLink() = default;
  virtual DeviceBytes read() = 0;
  /// Drops bytes that do not fit, like a UART.
  virtual void write(const DeviceBytes& bytes) = 0;
  /// Returns the line rate set by the host, bit/s.
  virtual int hostBaud() const = 0;
  /// Removes the device, or restores it with another name.
  virtual void setPlugged(bool plugged) = 0;
};

/// Opens a pseudo-terminal with a symbolic link at `path`. Throws DataError naming it if it cannot be created.
std::unique_ptr<DeviceLink> openPseudoTerminal(const std::string& path);
/// Opens a TCP server for one client at a time at a port of this host, which sends the greeting. Throws DataError.
std::unique_ptr<DeviceLink> openTcpServer(int port, const std::string& greeting);

/// Returns the steady clock of serveDevice(), ns.
DeviceTime serverTime();

/// Runs a device in real time until its session ends or `stop` returns true. `begin`: of the session by the steady
/// clock, ns, before which the device does not measure; nullopt: now. Returns the truth of all measurements, in real
/// time.
std::vector<DeviceTruth> serveDevice(SimulatedDevice& device, DeviceLink& link, const std::function<bool()>& stop,
                                     std::optional<DeviceTime> begin = {});

}  // namespace urban_nav_sim
