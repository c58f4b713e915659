// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/testing/graphs.hpp"

namespace urban_nav_core::testing {

/// A town of square blocks on gentle hills, and how the robot drives in it.
struct StreetOptions {
  double step_m = 0.05;        ///< from pose to pose: 1 m/s at 20 Hz
  double block_m = 40.0;       ///< from crossing to crossing
  double turn_radius_m = 5.0;  ///< of the middle of the street
  double lane_m = 1.5;         ///< to the right of the middle
  double hill_m = 1.0;         ///< height of the hills, 150 m apart; 0 keeps the streets level
  double visits = 3.0;         ///< how often a street is driven on average; the town is as large as that allows
};

/// Noise of the size that stereo odometry has at 20 Hz and 1 m/s (0.6 % and 0.05 deg over ten frames), and a metric
/// closure from images (5 cm, 0.6 deg).
GraphNoise streetNoise();

/// A robot that cannot move sideways drives through the town at 20 Hz, turns at random at crossings and comes back to
/// streets it knows, in the same and in the opposite direction on the other lane: z follows the hills, pitch and roll
/// too. `closures` of the places seen again (one a metre) are measured, spread evenly at random. Takes time and memory
/// in proportion to `poses`. Throws std::invalid_argument if so few places are seen again.
SimulatedGraph streetGraph(std::size_t poses, std::size_t closures, const GraphNoise& noise, std::uint64_t seed,
                           const StreetOptions& options = {});

}  // namespace urban_nav_core::testing
