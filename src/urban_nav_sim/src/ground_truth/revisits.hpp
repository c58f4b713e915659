// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "noise/noise.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_sim {

constexpr double kSamePlace = 7.5;    ///< m: largest distance of panoramas of one place (docs/files.md)
constexpr double kRevisitGap = 30.0;  ///< s: smallest time difference of a revisit

/// Two panoramas taken at one place; by index, `a` the earlier.
struct Revisit {
  std::size_t a = 0, b = 0;
  double distance = 0.0;     ///< m
  double heading_deg = 0.0;  ///< of b relative to a, about z, -180 ... 180, counter-clockwise
};

/// Returns all pairs within kSamePlace and more than kRevisitGap apart, in the order of b, then of a. Time and memory
/// are linear in the number of pairs.
std::vector<Revisit> findRevisits(const urban_nav_core::Trajectory& panoramas);

/// Output of a place recogniser: two panoramas of the same place.
struct Closure {
  std::size_t a = 0, b = 0;
  double probability = 1.0;
};

/// Returns the nearest revisit of each panorama that has one, in the order of b.
std::vector<Closure> trueClosures(const std::vector<Revisit>& revisits, const Noise& noise);

/// Returns `count` different pairs more than kRevisitGap and 10 m apart, with probabilities like the true ones, in the
/// order of b, then of a; fewer if the session has no such pairs.
std::vector<Closure> falseClosures(const urban_nav_core::Trajectory& panoramas, std::size_t count, const Noise& noise);

}  // namespace urban_nav_sim
