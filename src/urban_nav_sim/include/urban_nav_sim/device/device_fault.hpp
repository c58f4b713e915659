// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_sim/device/line_queue.hpp"

namespace urban_nav_sim {

/// Faults between a device and its host.
enum class DeviceFaultKind : std::uint8_t {
  Flip,       ///< one bit of a frame is wrong; value: share of the frames (default 0.01)
  Garbage,    ///< random bytes before a frame; value: their number (default 100)
  Cut,        ///< a frame ends in the middle; value: share of the frames (default 0.1)
  Length,     ///< a header with length 65535 before a frame
  Silence,    ///< nothing is sent
  Nak,        ///< commands are refused
  Late,       ///< replies are late; value: ms (default 200)
  Streaming,  ///< the device is already streaming at the start of the session
  Baud,       ///< the device changes its line rate; value: baud (default 9600)
  Mode,       ///< the configuration is changed
  Power,      ///< the device is off, then boots; value: s of booting (default 1)
  Unplug,     ///< the port disappears and returns with another name
  Gap,        ///< measurements are lost; value: their number (default 1)
  Delay,      ///< the least delay is longer; value: ms (default 5)
  Clock       ///< the counter of the device restarts
};
const char* toString(DeviceFaultKind kind);
/// "flip, garbage, ...".
std::string deviceFaultList();

/// A fault during a time interval, s since the begin of the session.
struct DeviceFault {
  DeviceFaultKind kind = DeviceFaultKind::Flip;
  double start = 0.0, duration = 1.0;
  std::optional<double> value;

  bool isActive(double t) const { return t >= start && t < start + duration; }
};

/// "KIND:START_S:DURATION_S[:VALUE]". Throws UserError with the valid values; `option`: source of the text.
DeviceFault parseDeviceFault(const std::string& text, const std::string& option = "--fault");

/// Returns the active fault of a kind at a time; null without one.
const DeviceFault* findDeviceFault(const std::vector<DeviceFault>& faults, DeviceFaultKind kind, double t);

}  // namespace urban_nav_sim
