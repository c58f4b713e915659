// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/testing/graphs.hpp"

namespace urban_nav_core::testing {

/// Town of square blocks on gentle hills, and the driving pattern of the robot.
struct StreetOptions {
  double step_m = 0.05;        ///< between poses: 1 m/s at 20 Hz
  double block_m = 40.0;       ///< between crossings
  double turn_radius_m = 5.0;  ///< for the middle of the street
  double lane_m = 1.5;         ///< right of the middle
  double hill_m = 1.0;         ///< height of the hills, 150 m apart; 0: level streets
  double visits = 3.0;         ///< mean number of drives along a street; determines the size of the town
};

/// Returns noise of typical stereo odometry at 20 Hz and 1 m/s (0.6 % and 0.05 deg over ten frames) and of metric
/// closures from images (5 cm, 0.6 deg).
GraphNoise streetNoise();

/// Non-holonomic robot that drives through the town at 20 Hz, turns at random at crossings and revisits streets in the
/// same and, on the other lane, in the opposite direction; z, pitch and roll follow the hills. `closures` of the
/// revisits (one a metre) are measured, drawn uniformly at random. Time and memory are proportional to `poses`. Throws
/// std::invalid_argument if there are fewer revisits.
SimulatedGraph streetGraph(std::size_t poses, std::size_t closures, const GraphNoise& noise, std::uint64_t seed,
                           const StreetOptions& options = {});

}  // namespace urban_nav_core::testing
