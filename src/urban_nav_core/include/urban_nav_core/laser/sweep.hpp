// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// One sweep of a 3D LiDAR: a turn of a spinning sensor, or one frame of a scanner without rings.
struct Sweep {
  /// What is known of when the beams were measured.
  enum class Times {
    Measured,  ///< every beam has its own stamp
    Unknown,   ///< every beam has the stamp `reference`; it was measured within `duration` around it
    Deskewed   ///< the beams were already moved to where `reference` would have seen them; their stamps are `reference`
  };

  StampNs reference = 0;  ///< time that poses of the sweep refer to: its middle, if the source does not define another
  double duration = 0.0;  ///< s from the first beam to the last; of sweeps without times: the time between sweeps
  Times times = Times::Unknown;
  std::vector<Beam> beams;  ///< valid beams in order of time, column and ring; directions in the frame of the sensor
};

}  // namespace urban_nav_core
