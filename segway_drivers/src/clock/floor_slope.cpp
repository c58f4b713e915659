// SPDX-License-Identifier: BSD-3-Clause
#include "clock/floor_slope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace segway_drivers {

namespace {

constexpr double kLeastSlopeSigma = 1e-12;  // s/s, above round-off

double hullEdgeSlope(const ClockPoint& a, const ClockPoint& b) { return (b.z - a.z) / (b.x - a.x); }

/// Integrals of t^n exp(-rate t) over [0, length] for n = 0, 1, 2.
struct DecayMoments {
  double zeroth, first, second;

  DecayMoments(double rate, double length) {
    const double u = rate * length;
    if (u < 1e-3) {
      zeroth = length * (1.0 - u / 2.0);
      first = length * length * (0.5 - u / 3.0);
      second = length * length * length * (1.0 / 3.0 - u / 4.0);
      return;
    }
    const double rest = std::exp(-u), part = std::isfinite(u) ? u : 0.0;
    zeroth = (1.0 - rest) / rate;
    first = (1.0 - rest * (1.0 + part)) / (rate * rate);
    second = (2.0 - rest * (2.0 + 2.0 * part + part * part)) / (rate * rate * rate);
  }
};

/// Moments of a density of slopes, about a slope.
struct SlopeMoments {
  double zeroth = 0.0, first = 0.0, second = 0.0;

  /// Adds a segment of the density that begins with `density` at `from` and decays at `rate` over `length` upwards
  /// (`sign` 1) or downwards (-1).
  void add(double density, double from, double sign, double rate, double length) {
    const DecayMoments moments(rate, length);
    zeroth += density * moments.zeroth;
    first += density * (from * moments.zeroth + sign * moments.first);
    second += density * (from * from * moments.zeroth + 2.0 * from * sign * moments.first + moments.second);
  }
};

}  // namespace

SlopeEstimate estimateFloorSlope(const std::vector<ClockPoint>& hull, double mean_x, double spacing) {
  // The edge over the mean, at which h is largest.
  std::size_t top = 1;
  while (top + 1 < hull.size() && hull[top].x < mean_x) ++top;
  const double peak = hullEdgeSlope(hull[top - 1], hull[top]);
  SlopeMoments moments;
  double log_density = 0.0;
  for (std::size_t i = top; i < hull.size(); ++i) {  // slopes above the peak: the line turns about hull[i]
    const double rate = (hull[i].x - mean_x) / spacing, from = hullEdgeSlope(hull[i - 1], hull[i]) - peak;
    const double length = i + 1 < hull.size() ? hullEdgeSlope(hull[i], hull[i + 1]) - peak - from
                                              : std::numeric_limits<double>::infinity();
    moments.add(std::exp(log_density), from, 1.0, rate, length);
    log_density -= rate * length;
  }
  log_density = 0.0;
  for (std::size_t i = top; i-- > 0;) {  // slopes below it
    const double rate = (mean_x - hull[i].x) / spacing, from = hullEdgeSlope(hull[i], hull[i + 1]) - peak;
    const double length =
        i > 0 ? from - hullEdgeSlope(hull[i - 1], hull[i]) + peak : std::numeric_limits<double>::infinity();
    moments.add(std::exp(log_density), from, -1.0, rate, length);
    log_density -= rate * length;
  }
  const double mean = moments.first / moments.zeroth;
  return {peak + mean,
          std::max(std::sqrt(std::max(moments.second / moments.zeroth - mean * mean, 0.0)), kLeastSlopeSigma)};
}

}  // namespace segway_drivers
