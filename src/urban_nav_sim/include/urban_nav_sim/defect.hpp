// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "urban_nav_sim/sensor.hpp"

namespace urban_nav_sim {

/// Defects of a sensor or its stamps. Each sensor has some of them.
enum class Defect : std::uint8_t {
  Noise,       ///< from measurement to measurement
  Bias,        ///< constant or drifting
  Blur,        ///< smear by motion
  Vignetting,  ///< darker corners, imagers of unequal sensitivity
  Exposure,    ///< automatic, with lag; without it, the exposure of the first image
  Lens,        ///< raw stereo images: distorted, rows not aligned
  Edges,       ///< echoes from two surfaces mix
  Losses,      ///< weak echoes are lost
  Steps,       ///< quantisation of the device
  Offset,      ///< lasers: ranges 35 mm too long, the limit of the data sheet; IMU: large biases
  Scale,       ///< constant scale errors, of the IMU with non-orthogonal axes
  Delay,       ///< stamps with a constant delay
  Axes,        ///< x and y exchanged
  Degrees,     ///< rates in deg/s
  Ned,         ///< axes forward, right, down
  Gravity,     ///< accelerations without gravity
  Tyres,       ///< radii and track other than nominal
  Slip,        ///< of wheels
  Multipath,   ///< echoes of satellites from walls
  Gaps,        ///< no fix with too little visible sky
  Times,       ///< points of a sweep without times (all zero), stamp of its end
  Jitter,      ///< of stamps
  Clock        ///< offset and skew of the device's clock, which drivers usually correct
};

/// The defects of all sensors, switched individually.
class Defects {
 public:
  /// Defects that are on by default: all but Lens, Offset, Scale, Delay, Axes, Degrees, Ned, Gravity, Times
  /// and Clock.
  Defects();

  bool has(Sensor sensor, Defect defect) const { return on_.count({sensor, defect}) != 0; }
  /// `word`: SENSOR:DEFECT as on the command line; `all`: each sensor with the defect, or each default defect of the
  /// sensor. Throw UserError for unknown names, listing the known ones; `where`: the option.
  void switchOn(const std::string& word, const std::string& where = "--with");
  void switchOff(const std::string& word, const std::string& where = "--without");

 private:
  std::set<std::pair<Sensor, Defect>> on_;
};

/// Returns a line per sensor for --help.
std::string defectHelp();

}  // namespace urban_nav_sim
