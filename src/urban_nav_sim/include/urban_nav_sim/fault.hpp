// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "urban_nav_sim/sensor.hpp"

namespace urban_nav_sim {

/// What can go wrong with what a sensor sends.
enum class FaultKind : std::uint8_t {
  Drop,     ///< messages are missing; value: their share, 0...1 (default 0.3)
  Freeze,   ///< the last measurement before the fault, or else the first, is repeated under new stamps
  Swap,     ///< left and right exchanged (stereo, lasers); others: as freeze
  Corrupt,  ///< rubbish in a share of the rows, beams or numbers; value: that share, 0...1 (default 0.3)
  Jump,     ///< stamps are later by value in s (default 10; may be below zero)
  Unplug,   ///< nothing comes
  Nan,      ///< numbers are NaN; pictures, which have none, are black
  Knock,    ///< stereo alone: the right camera is turned about its y axis by value in deg (default 0.2)
  Drift,    ///< stamps become later, evenly over the duration, by value in s (default 0.1), and stay so
  Scale,    ///< stereo alone, the whole session: the baseline of camera_info is value times the true one (default 1.01)
  Rain,     ///< stereo alone: streaks of rain, other ones in each picture; value: share of the pixels (default 0.05)
  Dark      ///< stereo alone: pictures of value times the brightness (default 0.05), with the noise of the sensor
};
/// "drop", "freeze", "swap", "corrupt", "jump", "unplug", "nan", "knock", "drift", "scale", "rain", "dark".
const char* toString(FaultKind kind);
std::string faultList();

/// A fault of one sensor for some time, s since the session began. A duration of 0 lasts to the end.
struct Fault {
  FaultKind kind = FaultKind::Drop;
  Sensor sensor = Sensor::Stereo;
  double start = 0.0, duration = 1.0;
  std::optional<double> value;

  bool isActive(double t) const {
    return t >= start && (duration == 0.0 || kind == FaultKind::Drift || t < start + duration);
  }
};

/// "KIND:SENSOR:START_S:DURATION_S[:VALUE]"; sensor "clock": that of the stereo camera.
/// Throws UserError that says what is wrong and what is allowed; `option`: where the text stood.
Fault parseFault(const std::string& text, const std::string& option = "--fault");

}  // namespace urban_nav_sim
