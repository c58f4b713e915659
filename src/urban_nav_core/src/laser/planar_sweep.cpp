// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/planar_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {
namespace {

constexpr double kMostTilt = 10.0 * M_PI / 180.0;  // rad: distances are 1.5 % too long at most
constexpr double kLongestScan = 1.0;               // s; a turn of the slowest planar lasers takes 0.2 s

}  // namespace

double tiltOfLaser(const Pose& T_base_laser) { return std::acos(std::min(1.0, std::abs(T_base_laser.R()(2, 2)))); }

bool isHorizontal(const Pose& T_base_laser) { return tiltOfLaser(T_base_laser) <= kMostTilt; }

Sweep PlanarSweepReader::read(const PlanarScan& scan) {
  const double last_beam = scan.ranges.empty() ? 0.0 : static_cast<double>(scan.ranges.size() - 1);
  const double span = scan.time_step * last_beam;
  const double since = last_ > 0 && scan.stamp > last_ ? secondsBetween(last_, scan.stamp) : 0.0;
  last_ = scan.stamp;
  Sweep sweep;
  sweep.beams = toScan(scan).beams;
  if (std::abs(span) > 0.0 && std::abs(span) <= kLongestScan) {
    sweep.times = Sweep::Times::Measured;
    sweep.reference = scan.stamp + static_cast<StampNs>(std::llround(0.5e9 * span));
    sweep.duration = std::abs(span);
    return sweep;
  }
  sweep.times = Sweep::Times::Unknown;
  sweep.reference = scan.stamp;
  sweep.duration = std::min(kLongestScan, scan.period > 0.0 ? scan.period : since);
  for (Beam& beam : sweep.beams) beam.stamp = sweep.reference;
  return sweep;
}

}  // namespace urban_nav_core
