// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "urban_nav_sim/sensor.hpp"

namespace urban_nav_sim {

/// Faults of the data of a sensor.
enum class FaultKind : std::uint8_t {
  Drop,     ///< messages are missing; value: their share, 0...1 (default 0.3)
  Freeze,   ///< the last measurement before the fault, or the first one, is repeated with new stamps
  Swap,     ///< left and right exchanged (stereo, lasers); other sensors: as freeze
  Corrupt,  ///< random data in a share of the rows, beams or numbers; value: that share, 0...1 (default 0.3)
  Jump,     ///< stamps are later by value in s (default 10; may be negative)
  Unplug,   ///< no data
  Nan,      ///< numbers are NaN; images are black
  Knock,    ///< a mounting turns by value in deg (default kDefaultKnock): of stereo the right camera about its y axis,
            ///< the left one of the lasers about the axis of its scan plane, the head of the Ladybug about the vertical
  Drift,    ///< stamps are delayed linearly over the duration, up to value in s (default 0.1), then constant
  Scale,    ///< stereo only, entire session: the baseline of camera_info is value times the true one (default 1.01)
  Rain,     ///< stereo only: streaks of rain, different in each image; value: share of the pixels (default 0.05)
  Dark      ///< stereo only: images of value times the brightness (default 0.05), with the noise of the sensor
};
constexpr double kDefaultKnock = 0.2;  // deg

/// "drop", "freeze", "swap", "corrupt", "jump", "unplug", "nan", "knock", "drift", "scale", "rain", "dark".
const char* toString(FaultKind kind);
std::string faultList();

/// A fault of one sensor during a time interval, s since the begin of the session. A duration of 0 lasts to the end.
struct Fault {
  FaultKind kind = FaultKind::Drop;
  Sensor sensor = Sensor::Stereo;
  double start = 0.0, duration = 1.0;
  std::optional<double> value;

  bool isActive(double t) const {
    return t >= start && (duration == 0.0 || kind == FaultKind::Drift || t < start + duration);
  }
};

/// "KIND:SENSOR:START_S:DURATION_S[:VALUE]"; sensor "clock": that of the stereo camera. Throws UserError with the valid
/// values; `option`: source of the text.
Fault parseFault(const std::string& text, const std::string& option = "--fault");

}  // namespace urban_nav_sim
