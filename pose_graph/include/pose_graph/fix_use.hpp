// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "urban_nav_core/types/gps_reading.hpp"

namespace pose_graph {

using urban_nav_core::PositionFix;

/// What became of the fixes of a graph.
struct FixUse {
  std::size_t used = 0;
  std::size_t rejected = 0;   ///< contradict odometry, closures and most of the others: reflections
  std::size_t unplaced = 0;   ///< at times without a pose, or not finite
  double sigma_factor = 1.0;  ///< by which the stated standard deviations were multiplied, at least 1
  double moved = 0.0;         ///< m, the most that a pose was moved
};

}  // namespace pose_graph
