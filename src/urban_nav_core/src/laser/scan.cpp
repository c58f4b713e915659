// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/scan.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ostream>

namespace urban_nav_core {
namespace {

bool isValid(const PlanarScan& scan, float range) {
  return std::isfinite(range) && range > 0.0F && static_cast<double>(range) >= scan.range_min &&
         static_cast<double>(range) <= scan.range_max;
}

bool near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

}  // namespace

Scan toScan(const PlanarScan& scan) {
  assert(scan.intensities.empty() || scan.intensities.size() == scan.ranges.size());
  Scan out;
  out.stamp = scan.stamp;
  out.beams.reserve(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!isValid(scan, scan.ranges[i])) continue;
    const auto k = static_cast<double>(i);
    const double angle = scan.angle_first + k * scan.angle_step;
    Beam beam;
    beam.stamp = scan.stamp + static_cast<StampNs>(std::llround(k * scan.time_step * 1e9));
    beam.direction = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
    beam.range = scan.ranges[i];
    beam.intensity = scan.intensities.empty() || !std::isfinite(scan.intensities[i]) ? 0.0F : scan.intensities[i];
    out.beams.push_back(beam);
  }
  return out;
}

bool isApprox(const PlanarScan& a, const PlanarScan& b, double tolerance) {
  const bool same_ranges =
      std::equal(a.ranges.begin(), a.ranges.end(), b.ranges.begin(), b.ranges.end(), [&](float x, float y) {
        const bool valid_x = isValid(a, x), valid_y = isValid(b, y);
        return valid_x == valid_y && (!valid_x || near(static_cast<double>(x), static_cast<double>(y), tolerance));
      });
  const bool same_intensities = std::equal(
      a.intensities.begin(), a.intensities.end(), b.intensities.begin(), b.intensities.end(),
      [tolerance](float x, float y) { return near(static_cast<double>(x), static_cast<double>(y), tolerance); });
  return a.stamp == b.stamp && same_ranges && same_intensities && near(a.angle_first, b.angle_first, tolerance) &&
         near(a.angle_step, b.angle_step, tolerance) && near(a.time_step, b.time_step, tolerance) &&
         near(a.period, b.period, tolerance);
}

bool isApprox(const Scan& a, const Scan& b, double tolerance) {
  return a.stamp == b.stamp &&
         std::equal(a.beams.begin(), a.beams.end(), b.beams.begin(), b.beams.end(),
                    [tolerance](const Beam& x, const Beam& y) {
                      return x.stamp == y.stamp &&
                             near(static_cast<double>(x.range), static_cast<double>(y.range), tolerance) &&
                             near(static_cast<double>(x.intensity), static_cast<double>(y.intensity), tolerance) &&
                             static_cast<double>((x.direction - y.direction).norm()) <= tolerance;
                    });
}

std::ostream& operator<<(std::ostream& out, const PlanarScan& scan) {
  const auto valid =
      std::count_if(scan.ranges.begin(), scan.ranges.end(), [&scan](float range) { return isValid(scan, range); });
  return out << printStamp(scan.stamp) << " s: " << scan.ranges.size() << " beams from " << scan.angle_first
             << " rad by " << scan.angle_step << " rad, " << valid << " valid";
}

std::ostream& operator<<(std::ostream& out, const Scan& scan) {
  return out << printStamp(scan.stamp) << " s: " << scan.beams.size() << " beams";
}

}  // namespace urban_nav_core
