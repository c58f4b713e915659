// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "urban_nav_sim/sensor.hpp"

namespace urban_nav_sim {

/// What is not ideal about a sensor or its stamps. Not every sensor has every one.
enum class Defect : std::uint8_t {
  Noise,       ///< from measurement to measurement
  Bias,        ///< constant or drifting
  Blur,        ///< smear by motion
  Vignetting,  ///< darker corners, imagers of unequal sensitivity
  Exposure,    ///< automatic, with its lag; without: that of the first picture
  Lens,        ///< stereo pictures as the imagers see them: distorted, rows not aligned
  Edges,       ///< echoes from two surfaces mix
  Losses,      ///< weak echoes are lost
  Steps,       ///< of what the device counts in
  Offset,      ///< of lasers: ranges 35 mm too long, the most that the data sheet allows; of the IMU: large biases
  Scale,       ///< constant scale errors, of the IMU with axes that are not square to each other
  Delay,       ///< stamps that are late by a constant time
  Axes,        ///< x and y exchanged
  Degrees,     ///< rates in deg/s
  Ned,         ///< axes forward, right, down
  Gravity,     ///< accelerations without gravity
  Tyres,       ///< radii and track other than nominal
  Slip,        ///< of wheels
  Multipath,   ///< echoes of satellites from walls
  Gaps,        ///< no fix where too little sky is seen
  Times,       ///< points of a sweep without times: all zero, the stamp that of the end
  Jitter,      ///< of stamps
  Clock        ///< offset and skew of the device's clock, which drivers usually correct
};

/// The defects of all sensors, each to be switched by itself.
class Defects {
 public:
  /// Defects that are on by default: all but Lens, Offset, Scale, Delay, Axes, Degrees, Ned, Gravity, Times
  /// and Clock.
  Defects();

  bool has(Sensor sensor, Defect defect) const { return on_.count({sensor, defect}) != 0; }
  /// `word`: SENSOR:DEFECT as on the command line, `all` standing for each sensor that has the defect, or for each
  /// defect of the sensor that is usually there. Throw UserError for what there is not, naming what there is; `where`:
  /// the option.
  void switchOn(const std::string& word, const std::string& where = "--with");
  void switchOff(const std::string& word, const std::string& where = "--without");

 private:
  std::set<std::pair<Sensor, Defect>> on_;
};

/// For --help: a line a sensor.
std::string defectHelp();

}  // namespace urban_nav_sim
