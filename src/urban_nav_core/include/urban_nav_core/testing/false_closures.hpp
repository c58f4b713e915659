// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/testing/graphs.hpp"

namespace urban_nav_core::testing {

/// How wrong recognitions are drawn (Suenderhauf and Protzel, Switchable constraints for robust pose graph SLAM, 2012).
enum class FalseClosures {
  Random,         ///< between any two poses
  Local,          ///< between poses at most 20 apart
  RandomGrouped,  ///< `group` in a row with one and the same transform, which support each other
  LocalGrouped,
};

/// Appends `count` false closures, as data/graphs/README.md defines them: each says that two places are nearly one
/// (0.3 m and 10 deg of deviation about each axis), with the information of the graph's first closure. A few are right
/// by chance; `wrong` tells. Throws std::invalid_argument for a graph with no closure or with too few poses.
void addFalseClosures(SimulatedGraph& graph, FalseClosures kind, std::size_t count, std::uint64_t seed,
                      std::size_t group = 10);

struct AliasOptions {
  std::size_t pairs = 3;      ///< of places that look alike
  std::size_t closures = 20;  ///< between the two of a pair
  double radius_m = 3.0;      ///< of a place
  double apart_m = 20.0;      ///< at least, between the two
};
/// Appends what a town with repeated facades gives: two distant places look alike, and whenever the robot comes by one
/// of them, a closure to a pose at the other says with the usual small noise where it would be were the two one. So
/// closures of one pair agree with each other and with the odometry in between, over all passes: no test of neighbours
/// or of pairs tells them from true ones, the rest of the graph alone does. All are wrong. Throws std::invalid_argument
/// for a graph without closures, or where no two poses are so far apart.
void addAliasedClosures(SimulatedGraph& graph, const AliasOptions& options, std::uint64_t seed);

}  // namespace urban_nav_core::testing
