// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "segway_drivers/clock/clock_filter.hpp"

namespace segway_drivers {

struct SlopeEstimate {
  double slope = 0.0, sigma = 0.0;  ///< s/s
};

/// Returns mean and standard deviation of the slope of the floor of points from their lower hull: at least two points
/// in order of x; `mean_x` of all points lies between the first and the last. Heights above the floor are modelled as
/// uniform near it with mean spacing `spacing`, s, above 0. A line of slope b below all points has at most height h(b)
/// at mean_x; without points below it its likelihood is exp(h(b) / spacing), since fewer points are expected above a
/// higher line. h is concave, and linear between the slopes of the hull edges, so the moments are exact. The mean has a
/// smaller error than the most likely slope, that of the edge over mean_x (Pitman 1939).
SlopeEstimate estimateFloorSlope(const std::vector<ClockPoint>& hull, double mean_x, double spacing);

}  // namespace segway_drivers
