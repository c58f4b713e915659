// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// One sweep of a 3D LiDAR: a revolution of a spinning sensor, or one frame of a scanner without rings.
struct Sweep {
  /// Knowledge of the beams' times.
  enum class Times {
    Measured,  ///< every beam has its own stamp
    Unknown,   ///< every beam has the stamp `reference`; it was measured within `duration` around it
    Deskewed   ///< motion was compensated by the source: beams are as seen at `reference`, which is their stamp
  };

  StampNs reference = 0;  ///< time to which poses of the sweep refer: its middle, unless the source defines another
  double duration = 0.0;  ///< s from the first beam to the last; for sweeps without times, the time between sweeps
  Times times = Times::Unknown;
  std::vector<Beam> beams;  ///< valid beams in order of time, column and ring; directions in the frame of the sensor
};

}  // namespace urban_nav_core
