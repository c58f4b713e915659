// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_sim/device/line_queue.hpp"

namespace urban_nav_sim {

/// What can go wrong between a device and its host.
enum class DeviceFaultKind : std::uint8_t {
  Flip,       ///< one bit of a frame is wrong; value: share of the frames (default 0.01)
  Garbage,    ///< random bytes before a frame; value: their number (default 100)
  Cut,        ///< a frame ends in the middle; value: share of the frames (default 0.1)
  Length,     ///< a header with length 65535 before a frame
  Silence,    ///< nothing is sent
  Nak,        ///< commands are refused
  Late,       ///< replies are late; value: ms (default 200)
  Streaming,  ///< the device streams already when the session begins
  Baud,       ///< the device changes its line rate; value: baud (default 9600)
  Mode,       ///< the configuration is another
  Power,      ///< the device is off, then boots; value: s of booting (default 1)
  Unplug,     ///< the port vanishes and returns under another name
  Gap,        ///< measurements are lost; value: their number (default 1)
  Delay,      ///< the least delay is longer; value: ms (default 5)
  Clock       ///< the counter of the device begins again
};
const char* toString(DeviceFaultKind kind);
/// "flip, garbage, ...".
std::string deviceFaultList();

/// A fault for some time, s since the session began.
struct DeviceFault {
  DeviceFaultKind kind = DeviceFaultKind::Flip;
  double start = 0.0, duration = 1.0;
  std::optional<double> value;

  bool isActive(double t) const { return t >= start && t < start + duration; }
};

/// "KIND:START_S:DURATION_S[:VALUE]". Throws UserError that names what is wrong and what is allowed; `option`: where
/// the text stood.
DeviceFault parseDeviceFault(const std::string& text, const std::string& option = "--fault");

/// Active fault of a kind at a time; null if there is none.
const DeviceFault* findDeviceFault(const std::vector<DeviceFault>& faults, DeviceFaultKind kind, double t);

}  // namespace urban_nav_sim
