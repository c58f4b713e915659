// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/laser_scan.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

sensor_msgs::LaserScan toLaserScanMessage(const urban_nav_core::PlanarScan& scan, const std::string& frame) {
  sensor_msgs::LaserScan message;
  message.header.stamp = toRosTime(scan.stamp);
  message.header.frame_id = frame;
  message.angle_min = static_cast<float>(scan.angle_first);
  message.angle_increment = static_cast<float>(scan.angle_step);
  message.angle_max =
      static_cast<float>(scan.angle_first + scan.angle_step * static_cast<double>(scan.ranges.size() - 1));
  message.time_increment = static_cast<float>(scan.time_step);
  message.scan_time = static_cast<float>(scan.period);
  message.range_min = static_cast<float>(scan.range_min);
  message.range_max = static_cast<float>(scan.range_max);
  message.ranges = scan.ranges;
  message.intensities = scan.intensities;
  return message;
}

namespace {

using urban_nav_core::LaserConvention;
using urban_nav_core::PlanarScan;
using urban_nav_core::ScanFault;
using urban_nav_core::ScanVerdict;

constexpr double kFarthest = 1e6;  // in any unit: beyond any laser
constexpr double kTurn = 2.0 * M_PI;
constexpr double kDegrees = M_PI / 180.0;
constexpr double kSameSpan = 0.1;    // relative tolerance between angle_max - angle_min and the sum of increments
constexpr double kLeastReach = 1.0;  // m: less than the range of any planar laser
constexpr double kFewValid = 0.1;    // share of beams
constexpr double kSpread = 1.05;     // ratio of quartiles of the ranges: a constant for "no return" has a ratio of 1

/// Angle of the first beam and angular step, as stated.
struct Angles {
  double first = 0.0, step = 0.0;
  double ends = 0.0;  ///< angle_max - angle_min; not finite: unknown
};

/// Derives an angle that is not finite, or an increment of zero, from the other two.
std::optional<Angles> readAngles(const sensor_msgs::LaserScan& message) {
  const double last = message.angle_max, steps = static_cast<double>(message.ranges.size()) - 1.0;
  Angles angles{message.angle_min, message.angle_increment, last - static_cast<double>(message.angle_min)};
  if ((!std::isfinite(angles.step) || angles.step == 0.0) && steps > 0.0) angles.step = angles.ends / steps;
  if (!std::isfinite(angles.first)) angles.first = last - steps * angles.step;
  if (!std::isfinite(angles.first) || !std::isfinite(angles.step) || (angles.step == 0.0 && steps > 0.0))
    return std::nullopt;
  return angles;
}

/// Returns whether one span equals the other in degrees.
bool isInDegrees(double degrees, double radians) {
  return std::abs(kDegrees * degrees / radians - 1.0) < kSameSpan && std::abs(radians) > 0.0;
}

void scaleAngles(Angles& angles, double scale, std::size_t beams) {
  const double span = angles.step * (static_cast<double>(beams) - 1.0);
  if (!isInDegrees(span, angles.ends)) angles.first *= scale;
  if (!isInDegrees(angles.ends, span)) angles.step *= scale;
}

/// Returns the time between beams, s: as stated, else from scan_time per revolution, else 0.
double readTimeStep(const sensor_msgs::LaserScan& message, double scale, double angle_step) {
  if (std::isfinite(message.time_increment)) return scale * static_cast<double>(message.time_increment);
  if (!std::isfinite(message.scan_time) || message.scan_time <= 0.0F) return 0.0;
  return static_cast<double>(message.scan_time) * std::min(1.0, std::abs(angle_step) / kTurn);
}

std::optional<PlanarScan> read(const sensor_msgs::LaserScan& message, const LaserConvention& convention) {
  std::optional<Angles> angles = readAngles(message);
  if (!angles || message.header.stamp.isZero()) return std::nullopt;
  if (convention.angle_scale != 1.0) scaleAngles(*angles, convention.angle_scale, message.ranges.size());
  PlanarScan scan;
  scan.stamp = toStampNs(message.header.stamp) - convention.delay;
  scan.angle_first = angles->first;
  scan.angle_step = angles->step;
  scan.time_step = readTimeStep(message, convention.time_scale, angles->step);
  scan.period = std::isfinite(message.scan_time) ? message.scan_time : 0.0F;
  scan.range_min = std::isfinite(message.range_min) ? static_cast<double>(message.range_min) : 0.0;
  scan.range_max = hasNoRangeLimit(message) ? kFarthest : static_cast<double>(message.range_max);
  scan.ranges = message.ranges;
  if (const double scale = convention.range_scale; scale != 1.0) {
    for (float& range : scan.ranges) range = static_cast<float>(scale * static_cast<double>(range));
    if (scale * scan.range_max >= kLeastReach) {  // otherwise the limits are already in metres
      scan.range_min *= scale;
      scan.range_max *= scale;
    }
  }
  if (message.intensities.size() == message.ranges.size()) scan.intensities = message.intensities;
  return scan;
}

/// Returns whether hardly any range is within the limits, although those outside are measurements.
bool isBeyondLimits(const PlanarScan& scan) {
  std::vector<float> finite;
  std::size_t valid = 0;
  for (const float range : scan.ranges) {
    if (!std::isfinite(range) || range <= 0.0F) continue;
    finite.push_back(range);
    valid += static_cast<double>(range) >= scan.range_min && static_cast<double>(range) <= scan.range_max ? 1 : 0;
  }
  if (finite.empty() || static_cast<double>(valid) > kFewValid * static_cast<double>(scan.ranges.size())) return false;
  std::sort(finite.begin(), finite.end());
  return static_cast<double>(finite[3 * finite.size() / 4]) > kSpread * static_cast<double>(finite[finite.size() / 4]);
}

/// Returns the fault of the units of a converted scan whose message states both end angles.
ScanVerdict checkUnits(const PlanarScan& scan, const sensor_msgs::LaserScan& message,
                       const LaserConvention& convention) {
  const double span = scan.angle_step * (static_cast<double>(scan.ranges.size()) - 1.0);
  const double ends = static_cast<double>(message.angle_max) - static_cast<double>(message.angle_min);
  if (convention.angle_scale == 1.0 && std::abs(ends) > 1.02 * kTurn && isInDegrees(ends, span))
    return {ScanFault::AngleUnit, std::abs(ends), kDegrees};
  ScanVerdict verdict = urban_nav_core::checkUnits(scan);
  if (verdict.fault != ScanFault::None || convention.range_scale != 1.0 || !isBeyondLimits(scan)) return verdict;
  PlanarScan unlimited = scan;
  unlimited.range_max = kFarthest;
  return urban_nav_core::checkUnits(unlimited);
}

}  // namespace

bool hasNoRangeLimit(const sensor_msgs::LaserScan& message) {
  return !std::isfinite(message.range_max) || message.range_max <= 0.0F || message.range_max <= message.range_min;
}

std::optional<PlanarScan> toPlanarScan(const sensor_msgs::LaserScan& message, const LaserConvention& convention) {
  std::optional<PlanarScan> scan = read(message, convention);
  if (scan && checkUnits(*scan, message, convention).fault != ScanFault::None) return std::nullopt;
  return scan;
}

ScanVerdict checkUnits(const sensor_msgs::LaserScan& message, const LaserConvention& convention) {
  const std::optional<PlanarScan> scan = read(message, convention);
  return scan ? checkUnits(*scan, message, convention) : ScanVerdict();
}

}  // namespace urban_nav_ros
