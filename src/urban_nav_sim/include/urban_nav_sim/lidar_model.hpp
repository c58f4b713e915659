// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_sim {

/// Kind of the simulated 3D LiDAR.
struct LidarModel {
  enum class Pattern {
    Rings,   ///< spinning sensor, each laser draws a ring (Velodyne)
    Rosette  ///< two rotating prisms, forward-looking, non-repeating curve (Livox)
  };
  static constexpr int kFewestRings = 16, kMostRings = 128, kRosetteLines = 6;

  Pattern pattern = Pattern::Rings;
  int rings = 64;  ///< lasers; of a rosette kRosetteLines
};

/// Parses the value of `--lidar`: the number of rings or `livox`. Throws UserError; `where`: the option.
LidarModel parseLidarModel(const std::string& word, const std::string& where);

}  // namespace urban_nav_sim
