// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/laser_scan.hpp"

#include <cmath>

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

constexpr double kFarthest = 1e6;  // in any unit: no laser reaches it

std::optional<urban_nav_core::PlanarScan> read(const sensor_msgs::LaserScan& message,
                                               const urban_nav_core::LaserConvention& convention) {
  for (const float number : {message.angle_min, message.angle_increment, message.time_increment})
    if (!std::isfinite(number)) return std::nullopt;
  if (message.header.stamp.isZero()) return std::nullopt;
  urban_nav_core::PlanarScan scan;
  scan.stamp = toStampNs(message.header.stamp) - convention.delay;
  scan.angle_first = convention.angle_scale * static_cast<double>(message.angle_min);
  scan.angle_step = convention.angle_scale * static_cast<double>(message.angle_increment);
  scan.time_step = message.time_increment;
  scan.period = std::isfinite(message.scan_time) ? message.scan_time : 0.0F;
  scan.range_min = std::isfinite(message.range_min) ? static_cast<double>(message.range_min) : 0.0;
  scan.range_max = hasNoRangeLimit(message) ? kFarthest : static_cast<double>(message.range_max);
  scan.ranges = message.ranges;
  if (convention.range_scale != 1.0) {
    for (float& range : scan.ranges) range = static_cast<float>(convention.range_scale * static_cast<double>(range));
    scan.range_min *= convention.range_scale;
    scan.range_max *= convention.range_scale;
  }
  if (message.intensities.size() == message.ranges.size()) scan.intensities = message.intensities;
  return scan;
}

}  // namespace

bool hasNoRangeLimit(const sensor_msgs::LaserScan& message) {
  return !std::isfinite(message.range_max) || message.range_max <= 0.0F || message.range_max <= message.range_min;
}

std::optional<urban_nav_core::PlanarScan> toPlanarScan(const sensor_msgs::LaserScan& message,
                                                       const urban_nav_core::LaserConvention& convention) {
  std::optional<urban_nav_core::PlanarScan> scan = read(message, convention);
  if (scan && urban_nav_core::checkUnits(*scan).fault != urban_nav_core::ScanFault::None) return std::nullopt;
  return scan;
}

urban_nav_core::ScanVerdict checkUnits(const sensor_msgs::LaserScan& message,
                                       const urban_nav_core::LaserConvention& convention) {
  const std::optional<urban_nav_core::PlanarScan> scan = read(message, convention);
  return scan ? urban_nav_core::checkUnits(*scan) : urban_nav_core::ScanVerdict();
}

}  // namespace urban_nav_ros
