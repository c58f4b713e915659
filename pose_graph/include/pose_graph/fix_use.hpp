// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "urban_nav_core/types/gps_reading.hpp"

namespace pose_graph {

using urban_nav_core::PositionFix;

/// Statistics of the position fixes of a graph.
struct FixUse {
  std::size_t used = 0;
  std::size_t rejected = 0;   ///< outliers with respect to odometry, closures and most other fixes: multipath
  std::size_t unplaced = 0;   ///< without a pose at that time, or not finite
  double sigma_factor = 1.0;  ///< factor applied to the stated standard deviations, at least 1
  double moved = 0.0;         ///< largest displacement of a pose, m
};

}  // namespace pose_graph
