// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "noise/noise.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_sim {

constexpr double kSamePlace = 7.5;    ///< m in space: nearer panoramas show one place (docs/files.md)
constexpr double kRevisitGap = 30.0;  ///< s: nearer in time it is not coming back

/// Two panoramas taken at one place; by index, `a` the earlier.
struct Revisit {
  std::size_t a = 0, b = 0;
  double distance = 0.0;     ///< m
  double heading_deg = 0.0;  ///< of b beside a, about z, -180 ... 180, counter-clockwise
};

/// All pairs within kSamePlace and more than kRevisitGap apart, in the order of b, then of a. Time and memory grow with
/// the number of pairs, not with its square.
std::vector<Revisit> findRevisits(const urban_nav_core::Trajectory& panoramas);

/// What a place recogniser says: these two panoramas show one place.
struct Closure {
  std::size_t a = 0, b = 0;
  double probability = 1.0;
};

/// For each panorama that has revisits, the one nearest to it. In the order of b.
std::vector<Closure> trueClosures(const std::vector<Revisit>& revisits, const Noise& noise);

/// `count` different pairs more than kRevisitGap and 10 m apart, as sure of themselves as the true ones, in the order
/// of b, then of a; fewer where the session has no such pairs.
std::vector<Closure> falseClosures(const urban_nav_core::Trajectory& panoramas, std::size_t count, const Noise& noise);

}  // namespace urban_nav_sim
