// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/testing/graphs.hpp"

namespace urban_nav_core::testing {

/// Distribution of false closures (Suenderhauf and Protzel, Switchable constraints for robust pose graph SLAM, 2012).
enum class FalseClosures {
  Random,         ///< between any two poses
  Local,          ///< between poses at most 20 apart
  RandomGrouped,  ///< sequences of `group` with the same transform, which support each other
  LocalGrouped,
};

/// Appends `count` false closures as defined in data/graphs/README.md: each asserts that two places nearly coincide
/// (deviation of 0.3 m and 10 deg about each axis), with the information of the graph's first closure. Those that are
/// right by chance have `wrong` false. Throws std::invalid_argument for a graph without closures or with too few poses.
void addFalseClosures(SimulatedGraph& graph, FalseClosures kind, std::size_t count, std::uint64_t seed,
                      std::size_t group = 10);
/// Number, size and distance of places with the same appearance.
struct AliasOptions {
  std::size_t pairs = 3;      ///< of places with the same appearance
  std::size_t closures = 20;  ///< between the two places of a pair
  double radius_m = 3.0;      ///< extent of a place
  double apart_m = 20.0;      ///< smallest distance of the two
};
/// Appends the perceptual aliasing of a town with repeated facades: two distant places have the same appearance, and at
/// each visit of one of them a closure to a pose at the other measures, with the usual noise, the pose that would hold
/// if the places were one. Closures of one pair are therefore consistent with each other and with the odometry between
/// them, over all visits: no test of neighbours or pairs detects them, only the rest of the graph does. All are wrong.
/// Throws std::invalid_argument for a graph without closures, or without two poses that far apart.
void addAliasedClosures(SimulatedGraph& graph, const AliasOptions& options, std::uint64_t seed);

}  // namespace urban_nav_core::testing
