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

std::optional<urban_nav_core::PlanarScan> toPlanarScan(const sensor_msgs::LaserScan& message) {
  for (const float number : {message.angle_min, message.angle_increment, message.time_increment, message.scan_time,
                             message.range_min, message.range_max})
    if (!std::isfinite(number)) return std::nullopt;
  if (message.header.stamp.isZero()) return std::nullopt;
  urban_nav_core::PlanarScan scan;
  scan.stamp = toStampNs(message.header.stamp);
  scan.angle_first = message.angle_min;
  scan.angle_step = message.angle_increment;
  scan.time_step = message.time_increment;
  scan.period = message.scan_time;
  scan.range_min = message.range_min;
  scan.range_max = message.range_max;
  scan.ranges = message.ranges;
  if (message.intensities.size() == message.ranges.size()) scan.intensities = message.intensities;
  return scan;
}

}  // namespace urban_nav_ros
