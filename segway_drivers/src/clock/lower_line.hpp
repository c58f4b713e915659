// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "segway_drivers/clock/clock_filter.hpp"

namespace segway_drivers {

/// Returns the lower convex hull of points in order of x.
std::vector<ClockPoint> lowerHull(const ClockPoint* points, std::size_t count);

/// Slope of a line below all points, and the points that share its floor.
struct LowerLine {
  double slope = 0.0;
  double slope_sigma = 0.0;  ///< s/s
  double points = 0.0;       ///< number of points in blocks on the floor
  double mean_x = 0.0;       ///< s, of these points
  double mean_z = 0.0;       ///< s, of these points
  double span = 0.0;         ///< s, from the first to the last of these points
  double spacing = 0.0;      ///< s, mean spacing in height of the lowest quarter of these points
};

/// Returns the line below all points that is as high as possible over the mean of the points on its floor. The points
/// are divided into blocks of `block` s; a block belongs to the floor if its lowest point is as close to the line as
/// the lowest points of adjacent blocks are to each other. Among the edges of the hull with slopes up to `limit`, the
/// line with the most blocks on its floor is chosen, so that an interval of raised delays does not tilt it. `skew`:
/// slope for the comparison of adjacent blocks. Empty for fewer than three points.
std::optional<LowerLine> fitLowerLine(const ClockPoint* points, std::size_t count, double block, double skew,
                                      double limit);

}  // namespace segway_drivers
